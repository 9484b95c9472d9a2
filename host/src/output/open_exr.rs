//! OpenEXR files.

use crate::aov::Aov;
use crate::effort::cut;
use crate::insight::{Aspect, Insight, Values};
use crate::picture::Picture;
use crate::seen::Seen;
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, Error, FlatSamples, Image, LineOrder, Text, WritableImage,
};
use glam::Vec3;
use oktant_shared::hit::Hit;
use oktant_shared::present::mean_color;
use std::io::{self, Seek, Write};

/// Lossless, and read by everything that reads OpenEXR.
const ENCODING: Encoding = Encoding {
    compression: Compression::ZIP16,
    blocks: Blocks::ScanLines,
    line_order: LineOrder::Increasing,
};

type Channel = AnyChannel<FlatSamples>;

/// Writes the light of a picture, linear RGB with the primaries of sRGB, as `R`, `G` and `B`, and the layers asked for
/// under names `LAYER.CHANNEL`, all as they are: neither exposed nor bent by a tone curve.
pub fn write(writer: impl Write + Seek, picture: &Picture, seen: &Seen, aovs: &[Aov]) -> io::Result<()> {
    let colors: Vec<Vec3> = picture.sums.iter().map(|sum| mean_color(*sum)).collect();
    let mut channels: Vec<Channel> = vectors(["R", "G", "B"], &colors).into();
    for aov in aovs {
        channels.extend(layer(*aov, picture, seen));
    }
    write_channels(writer, [picture.width, picture.height], channels)
}

/// Writes what pixels tell: numbers as the channel `Y`, not a number where there is none; what is seen under the names that
/// it has in layers.
pub fn write_insight(writer: impl Write + Seek, insight: &Insight) -> io::Result<()> {
    let channels = match (&insight.values, insight.aspect) {
        (Values::Numbers(numbers), _) => vec![floats("Y", numbers.clone())],
        (Values::Seen(seen), Aspect::Normals) => seen_layer(Aov::Normal, seen),
        (Values::Seen(seen), Aspect::Barycentrics) => seen_layer(Aov::Barycentrics, seen),
        (Values::Seen(seen), _) => seen_layer(Aov::Id, seen),
    };
    write_channels(writer, insight.size, channels)
}

fn write_channels(writer: impl Write + Seek, [width, height]: [u32; 2], channels: Vec<Channel>) -> io::Result<()> {
    let size = (width as usize, height as usize);
    let mut image = Image::from_encoded_channels(size, ENCODING, AnyChannels::sort(channels.into()));
    image.layer_data.attributes.software_name = Text::new_or_none(concat!("oktant ", env!("CARGO_PKG_VERSION")));
    image.write().to_buffered(writer).map_err(|error| match error {
        Error::Io(error) => error,
        other => io::Error::other(other),
    })
}

fn layer(aov: Aov, picture: &Picture, seen: &Seen) -> Vec<Channel> {
    match aov {
        Aov::Depth | Aov::Normal | Aov::Id | Aov::Barycentrics => seen_layer(aov, seen),
        Aov::Samples => {
            let weights = picture.sums.iter().map(|sum| sum.w).collect();
            vec![floats("samples.weight", weights)]
        }
        Aov::Rays => {
            let work = &picture.work;
            let cuts = picture.sums.iter().zip(work);
            vec![
                floats("rays.closest", work.iter().map(|work| work.x).collect()),
                floats("rays.shadow", work.iter().map(|work| work.y).collect()),
                floats("rays.cut", cuts.map(|(sum, work)| cut(*sum, *work) as f32).collect()),
            ]
        }
    }
}

/// A layer of what is seen first; none of what comes of samples.
fn seen_layer(aov: Aov, seen: &Seen) -> Vec<Channel> {
    let of_hits = |name, value: fn(&Hit) -> f32| floats(name, seen.hits.iter().map(value).collect());
    match aov {
        Aov::Depth => vec![of_hits(
            "depth.Z",
            |hit| {
                if hit.is_hit() { hit.t } else { f32::INFINITY }
            },
        )],
        Aov::Normal => vectors(["normal.X", "normal.Y", "normal.Z"], &seen.normals).into(),
        Aov::Id => {
            let ids = seen.hits.iter().map(|hit| hit.triangle).collect();
            vec![AnyChannel::new("id.triangle", FlatSamples::U32(ids))]
        }
        Aov::Barycentrics => vec![
            of_hits("barycentrics.u", |hit| hit.u),
            of_hits("barycentrics.v", |hit| hit.v),
        ],
        Aov::Samples | Aov::Rays => Vec::new(),
    }
}

fn vectors(names: [&'static str; 3], values: &[Vec3]) -> [Channel; 3] {
    [0, 1, 2].map(|axis| floats(names[axis], values.iter().map(|value| value[axis]).collect()))
}

fn floats(name: &'static str, values: Vec<f32>) -> Channel {
    AnyChannel::new(name, FlatSamples::F32(values))
}

#[cfg(test)]
mod tests {
    use super::*;
    use exr::prelude::{ReadChannels, ReadLayers, read};
    use glam::{Vec4, vec3, vec4};
    use std::io::Cursor;

    fn rendering() -> (Picture, Seen) {
        let picture = Picture {
            work: vec![vec4(4.0, 2.0, 0.5, 0.0), vec4(4.0, 0.0, 0.0, 0.0), Vec4::ZERO],
            ..Picture::of_sums(
                3,
                1,
                vec![vec4(0.3, 4e10, 1e-20, 3.0), vec4(-0.0, 5.0, 6.0, 2.0), Vec4::ZERO],
            )
        };
        let hit = Hit {
            t: 1.0 / 3.0,
            triangle: 5,
            u: 0.1,
            v: 0.7,
        };
        let plane = Hit {
            t: 9e9,
            triangle: 1 << 31 | 2,
            u: 0.0,
            v: 0.0,
        };
        let seen = Seen {
            width: 3,
            hits: vec![hit, plane, Hit::miss(f32::MAX)],
            normals: vec![vec3(0.6, -0.8, 0.0), Vec3::Y, Vec3::ZERO],
        };
        (picture, seen)
    }

    fn read_back(aovs: &[Aov]) -> Vec<(String, FlatSamples)> {
        let (picture, seen) = rendering();
        let mut file = Cursor::new(Vec::new());
        write(&mut file, &picture, &seen, aovs).unwrap();
        let image = read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .first_valid_layer()
            .all_attributes()
            .from_buffered(Cursor::new(file.into_inner()))
            .unwrap();
        assert_eq!((image.layer_data.size.0, image.layer_data.size.1), (3, 1));
        let channels = image.layer_data.channel_data.list;
        channels
            .into_iter()
            .map(|channel| (channel.name.to_string(), channel.sample_data))
            .collect()
    }

    #[test]
    fn light_comes_back_to_the_last_bit() {
        let floats = |values: &[f32]| FlatSamples::F32(values.into());
        assert_eq!(
            read_back(&[]),
            [
                ("B".into(), floats(&[1e-20 / 3.0, 3.0, 1.0])),
                ("G".into(), floats(&[4e10 / 3.0, 2.5, 0.0])),
                ("R".into(), floats(&[0.3 / 3.0, 0.0, 1.0])),
            ]
        );
    }

    #[test]
    fn layers_have_their_names_and_values() {
        let channels = read_back(&Aov::ALL);
        let names: Vec<&str> = channels.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(
            names,
            [
                "B",
                "G",
                "R",
                "barycentrics.u",
                "barycentrics.v",
                "depth.Z",
                "id.triangle",
                "normal.X",
                "normal.Y",
                "normal.Z",
                "rays.closest",
                "rays.cut",
                "rays.shadow",
                "samples.weight",
            ]
        );
        for (name, wanted) in [
            ("barycentrics.u", [0.1, 0.0, 0.0]),
            ("barycentrics.v", [0.7, 0.0, 0.0]),
            ("depth.Z", [1.0 / 3.0, 9e9, f32::INFINITY]),
            ("normal.X", [0.6, 0.0, 0.0]),
            ("normal.Y", [-0.8, 1.0, 0.0]),
            ("normal.Z", [0.0, 0.0, 0.0]),
            ("rays.closest", [4.0, 4.0, 0.0]),
            ("rays.shadow", [2.0, 0.0, 0.0]),
            ("rays.cut", [0.5 / 3.0, 0.0, 0.0]),
            ("samples.weight", [3.0, 2.0, 0.0]),
        ] {
            let (_, values) = channels.iter().find(|(channel, _)| channel == name).unwrap();
            assert_eq!(*values, FlatSamples::F32(wanted.into()), "{name}");
        }
        let (_, ids) = channels.iter().find(|(channel, _)| channel == "id.triangle").unwrap();
        assert_eq!(*ids, FlatSamples::U32(vec![5, 1 << 31 | 2, u32::MAX]));
    }

    #[test]
    fn only_the_layers_asked_for_are_there() {
        let names: Vec<String> = read_back(&[Aov::Id]).into_iter().map(|(name, _)| name).collect();
        assert_eq!(names, ["B", "G", "R", "id.triangle"]);
    }
}
