//! Small glTF files, made by hand.

use serde_json::{Map, Value, json};

/// A file in the making: a scene with one node, which shows the mesh 0.
#[derive(Clone)]
pub struct Glb {
    pub json: Value,
    pub binary: Vec<u8>,
}

impl Glb {
    /// One mesh of one primitive with these positions and triangles.
    pub fn new(positions: &[[f32; 3]], triangles: &[[u16; 3]]) -> Self {
        let mut glb = Glb {
            json: json!({
                "asset": {"version": "2.0"},
                "scene": 0,
                "scenes": [{"nodes": [0]}],
                "nodes": [{"mesh": 0}],
                "meshes": [{"primitives": [{"attributes": {}}]}],
                "accessors": [],
                "bufferViews": [],
            }),
            binary: Vec::new(),
        };
        glb.attribute("POSITION", "VEC3", positions.as_flattened());
        let bytes: Vec<u8> = triangles
            .as_flattened()
            .iter()
            .flat_map(|index| index.to_le_bytes())
            .collect();
        let indices = glb.accessor(
            &bytes,
            json!({"componentType": 5123, "count": triangles.len() * 3, "type": "SCALAR"}),
        );
        glb.json["meshes"][0]["primitives"][0]["indices"] = indices.into();
        glb
    }

    /// A square of two by two at y = 0 around the origin, its front upwards, with normals.
    pub fn floor() -> Self {
        let mut glb = Glb::new(
            &[[-1.0, 0.0, -1.0], [-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, -1.0]],
            &[[0, 1, 2], [0, 2, 3]],
        );
        glb.attribute("NORMAL", "VEC3", &[[0.0, 1.0, 0.0]; 4].concat());
        glb
    }

    /// Gives the primitive another attribute.
    pub fn attribute(&mut self, name: &str, kind: &str, numbers: &[f32]) {
        let components = match kind {
            "VEC2" => 2,
            "VEC3" => 3,
            _ => 4,
        };
        let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
        let count = numbers.len() / components;
        let id = self.accessor(&bytes, json!({"componentType": 5126, "count": count, "type": kind}));
        self.json["meshes"][0]["primitives"][0]["attributes"][name] = id.into();
    }

    /// Adds an accessor of these bytes.
    pub fn accessor(&mut self, bytes: &[u8], mut accessor: Value) -> usize {
        let view = self.view(bytes);
        accessor["bufferView"] = view.into();
        let accessors = self.json["accessors"].as_array_mut().unwrap();
        accessors.push(accessor);
        accessors.len() - 1
    }

    /// Adds a view of these bytes.
    pub fn view(&mut self, bytes: &[u8]) -> usize {
        let view = json!({"buffer": 0, "byteOffset": self.binary.len(), "byteLength": bytes.len()});
        self.binary.extend(bytes);
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        let views = self.json["bufferViews"].as_array_mut().unwrap();
        views.push(view);
        views.len() - 1
    }

    /// Gives the primitive a material.
    pub fn material(mut self, material: Value) -> Self {
        self.json["materials"] = json!([material]);
        self.json["meshes"][0]["primitives"][0]["material"] = 0.into();
        self
    }

    /// Adds a node to the scene.
    pub fn node(mut self, node: Value) -> Self {
        let nodes = self.json["nodes"].as_array_mut().unwrap();
        nodes.push(node);
        let id = nodes.len() - 1;
        self.json["scenes"][0]["nodes"].as_array_mut().unwrap().push(id.into());
        self
    }

    /// Adds a light, and a node with it.
    pub fn light(mut self, light: Value, place: Value) -> Self {
        let lights = &mut self.json["extensions"]["KHR_lights_punctual"]["lights"];
        if lights.is_null() {
            *lights = json!([]);
        }
        let lights = lights.as_array_mut().unwrap();
        lights.push(light);
        let mut node: Map<String, Value> = place.as_object().unwrap().clone();
        node.insert(
            "extensions".into(),
            json!({"KHR_lights_punctual": {"light": lights.len() - 1}}),
        );
        self.node(node.into())
    }

    /// The bytes of a `.glb`.
    pub fn bytes(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        if json.get("buffers").is_none() {
            json["buffers"] = json!([{"byteLength": self.binary.len()}]);
        }
        let mut text = json.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut file = b"glTF".to_vec();
        let length = 12 + 8 + text.len() + 8 + self.binary.len();
        for word in [2, length as u32, text.len() as u32] {
            file.extend(word.to_le_bytes());
        }
        file.extend(b"JSON");
        file.extend(text);
        file.extend((self.binary.len() as u32).to_le_bytes());
        file.extend(b"BIN\0");
        file.extend(&self.binary);
        file
    }
}
