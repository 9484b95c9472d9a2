//! Embree 3.13, ray by ray, through the few functions that this takes.

use crate::contestant::{Contestant, Entry, Failure, hit};
use glam::Vec3;
use oktant::mesh::Mesh;
use oktant_shared::hit::Hit;
use oktant_shared::ray::Ray;
use std::ffi::{CString, c_char, c_int, c_void};
use std::sync::atomic::{AtomicIsize, Ordering};

type Handle = *mut c_void;

/// `RTCRay`.
#[repr(C, align(16))]
#[derive(Clone, Copy)]
struct PeerRay {
    origin: [f32; 3],
    t_near: f32,
    direction: [f32; 3],
    time: f32,
    t_far: f32,
    mask: u32,
    id: u32,
    flags: u32,
}

/// `RTCHit`.
#[repr(C, align(16))]
struct PeerHit {
    normal: [f32; 3],
    u: f32,
    v: f32,
    primitive: u32,
    geometry: u32,
    instance: u32,
}

/// `RTCRayHit`.
#[repr(C, align(16))]
struct RayHit {
    ray: PeerRay,
    hit: PeerHit,
}

/// `RTCIntersectContext`, with room for what some builds of Embree have behind it.
#[repr(C)]
struct Context {
    flags: c_int,
    filter: *const c_void,
    instance: u32,
    rest: [u32; 5],
}

const INVALID: u32 = u32::MAX;
const GEOMETRY_TRIANGLE: c_int = 0;
const BUFFER_INDEX: c_int = 0;
const BUFFER_VERTEX: c_int = 1;
const FORMAT_UINT3: c_int = 0x5003;
const FORMAT_FLOAT3: c_int = 0x9003;
const QUALITY_MEDIUM: c_int = 1;
const ROBUST: c_int = 1 << 2;

type Monitor = unsafe extern "C" fn(*mut c_void, isize, bool) -> bool;

unsafe extern "C" {
    fn rtcNewDevice(config: *const c_char) -> Handle;
    fn rtcReleaseDevice(device: Handle);
    fn rtcGetDeviceError(device: Handle) -> c_int;
    fn rtcSetDeviceMemoryMonitorFunction(device: Handle, monitor: Monitor, user: *mut c_void);
    fn rtcNewScene(device: Handle) -> Handle;
    fn rtcReleaseScene(scene: Handle);
    fn rtcSetSceneFlags(scene: Handle, flags: c_int);
    fn rtcSetSceneBuildQuality(scene: Handle, quality: c_int);
    fn rtcCommitScene(scene: Handle);
    fn rtcNewGeometry(device: Handle, kind: c_int) -> Handle;
    fn rtcReleaseGeometry(geometry: Handle);
    fn rtcSetSharedGeometryBuffer(
        geometry: Handle,
        kind: c_int,
        slot: u32,
        format: c_int,
        data: *const c_void,
        offset: usize,
        stride: usize,
        count: usize,
    );
    fn rtcCommitGeometry(geometry: Handle);
    fn rtcAttachGeometry(scene: Handle, geometry: Handle) -> u32;
    fn rtcIntersect1(scene: Handle, context: *mut Context, ray_hit: *mut RayHit);
    fn rtcOccluded1(scene: Handle, context: *mut Context, ray: *mut PeerRay);
}

struct Embree {
    device: Handle,
    scene: Handle,
    /// What Embree has allocated; it holds the address.
    bytes: Box<AtomicIsize>,
    /// The scene refers to it.
    _mesh: Mesh,
}

// SAFETY: handles belong to no thread.
unsafe impl Send for Embree {}
// SAFETY: a committed scene may be traced from many threads at once.
unsafe impl Sync for Embree {}

impl Drop for Embree {
    fn drop(&mut self) {
        // SAFETY: both are held once, and the device lives as long as its scene.
        unsafe {
            rtcReleaseScene(self.scene);
            rtcReleaseDevice(self.device);
        }
    }
}

unsafe extern "C" fn monitor(user: *mut c_void, bytes: isize, _: bool) -> bool {
    // SAFETY: the address is that of the counter that lives as long as the device.
    let counter = unsafe { &*user.cast::<AtomicIsize>() };
    counter.fetch_add(bytes, Ordering::Relaxed);
    true
}

fn peer_ray(ray: &Ray) -> PeerRay {
    PeerRay {
        origin: ray.origin.to_array(),
        t_near: ray.t_min,
        direction: ray.direction.to_array(),
        time: 0.0,
        t_far: ray.t_max,
        mask: u32::MAX,
        id: 0,
        flags: 0,
    }
}

fn context() -> Context {
    Context {
        flags: 0,
        filter: std::ptr::null(),
        instance: INVALID,
        rest: [0; 5],
    }
}

impl Embree {
    fn build(who: &'static str, mut mesh: Mesh, threads: usize, flags: c_int) -> Result<Box<dyn Contestant>, Failure> {
        let failed = |reason: String| Failure { who, reason };
        let config = CString::new(format!("threads={threads}")).map_err(|error| failed(error.to_string()))?;
        let bytes = Box::new(AtomicIsize::new(0));
        // SAFETY: the configuration ends in a zero; the counter outlives the device.
        let device = unsafe { rtcNewDevice(config.as_ptr()) };
        if device.is_null() {
            return Err(failed("there is no device".to_owned()));
        }
        // Embree reads 16 bytes of each vertex.
        mesh.positions.push(Vec3::ZERO);
        // SAFETY: as above; all handles are live, both buffers have the size that is told, and live as long as the scene.
        let scene = unsafe {
            let user = std::ptr::from_ref(&*bytes).cast_mut().cast();
            rtcSetDeviceMemoryMonitorFunction(device, monitor, user);
            let scene = rtcNewScene(device);
            rtcSetSceneFlags(scene, flags);
            rtcSetSceneBuildQuality(scene, QUALITY_MEDIUM);
            let geometry = rtcNewGeometry(device, GEOMETRY_TRIANGLE);
            let vertices = mesh.positions.as_ptr().cast();
            let corners = mesh.positions.len() - 1;
            rtcSetSharedGeometryBuffer(geometry, BUFFER_VERTEX, 0, FORMAT_FLOAT3, vertices, 0, 12, corners);
            let indices = mesh.triangles.as_ptr().cast();
            let triangles = mesh.triangles.len();
            rtcSetSharedGeometryBuffer(geometry, BUFFER_INDEX, 0, FORMAT_UINT3, indices, 0, 12, triangles);
            rtcCommitGeometry(geometry);
            rtcAttachGeometry(scene, geometry);
            rtcReleaseGeometry(geometry);
            rtcCommitScene(scene);
            scene
        };
        let built = Embree {
            device,
            scene,
            bytes,
            _mesh: mesh,
        };
        // SAFETY: the device is live.
        match unsafe { rtcGetDeviceError(built.device) } {
            0 => Ok(Box::new(built)),
            error => Err(failed(format!("error {error}"))),
        }
    }
}

impl Contestant for Embree {
    fn closest(&self, rays: &[Ray], hits: &mut [Hit]) {
        let mut context = context();
        for (ray, found) in rays.iter().zip(hits) {
            let mut both = RayHit {
                ray: peer_ray(ray),
                hit: PeerHit {
                    normal: [0.0; 3],
                    u: 0.0,
                    v: 0.0,
                    primitive: INVALID,
                    geometry: INVALID,
                    instance: INVALID,
                },
            };
            // SAFETY: the scene is committed, ray and context are whole and aligned.
            unsafe { rtcIntersect1(self.scene, &mut context, &mut both) };
            *found = if both.hit.geometry == INVALID {
                Hit::miss(ray.t_max)
            } else {
                hit(both.ray.t_far, both.hit.primitive)
            };
        }
    }

    fn any(&self, rays: &[Ray], found: &mut [bool]) {
        let mut context = context();
        for (ray, found) in rays.iter().zip(found) {
            let mut ray = peer_ray(ray);
            // SAFETY: as above.
            unsafe { rtcOccluded1(self.scene, &mut context, &mut ray) };
            *found = ray.t_far < 0.0;
        }
    }

    fn bytes(&self) -> Option<usize> {
        usize::try_from(self.bytes.load(Ordering::Relaxed)).ok()
    }
}

pub fn entries() -> Vec<Entry> {
    vec![
        Entry {
            name: "embree fast",
            is_ours: false,
            build: |mesh, threads| Embree::build("embree fast", mesh, threads, 0),
        },
        Entry {
            name: "embree robust",
            is_ours: false,
            build: |mesh, threads| Embree::build("embree robust", mesh, threads, ROBUST),
        },
    ]
}
