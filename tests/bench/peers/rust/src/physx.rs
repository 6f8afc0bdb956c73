// SPDX-License-Identifier: MIT
//! PhysX's capsule controller, PxController::move. It moves by a displacement and knows no velocity: gravity and jumps
//! are integrated here, as in its samples.
use crate::method::{method_of, Character, Controller, Level, Method, Place};
use physx_sys::*;
use std::ptr::{null, null_mut};
use std::sync::OnceLock;

/// m: shorter rests of a motion are dropped; the value of its samples.
const MIN_DISTANCE: f32 = 0.001;

struct Walker {
    manager: *mut PxControllerManager,
    controller: *mut PxController,
    rise: f32,
    grounded: bool,
}

struct Physx {
    dispatcher: *mut PxDefaultCpuDispatcher,
    scene: *mut PxScene,
    mesh: *mut PxTriangleMesh,
    filters: PxControllerFilters,
    walkers: Vec<Walker>,
    dt: f32,
    gravity: f32,
    jump_speed: f32,
}

/// There is one of it in a process, and it stays.
fn physics() -> *mut PxPhysics {
    static PHYSICS: OnceLock<usize> = OnceLock::new();
    *PHYSICS.get_or_init(|| unsafe { physx_create_physics(physx_create_foundation()) as usize }) as *mut PxPhysics
}

fn vector(v: [f64; 3]) -> PxVec3 {
    PxVec3 { x: v[0] as f32, y: v[1] as f32, z: v[2] as f32 }
}

unsafe fn make_scene(dispatcher: *mut PxDefaultCpuDispatcher, gravity: f32) -> *mut PxScene {
    unsafe {
        let mut desc = PxSceneDesc_new(PxPhysics_getTolerancesScale(physics()));
        desc.gravity = PxVec3 { x: 0.0, y: 0.0, z: -gravity };
        desc.cpuDispatcher = dispatcher.cast();
        desc.filterShader = get_default_simulation_filter_shader();
        PxPhysics_createScene_mut(physics(), &desc)
    }
}

unsafe fn cook(level: &Level) -> *mut PxTriangleMesh {
    let vertices: Vec<PxVec3> = (0..level.vertex_count).map(|i| vector(level.vertex(i))).collect();
    unsafe {
        let params = PxCookingParams_new(PxPhysics_getTolerancesScale(physics()));
        let mut desc = PxTriangleMeshDesc_new();
        desc.points.stride = size_of::<PxVec3>() as u32;
        desc.points.count = level.vertex_count;
        desc.points.data = vertices.as_ptr().cast();
        desc.triangles.stride = 12;
        desc.triangles.count = level.triangle_count;
        desc.triangles.data = level.triangles().as_ptr().cast();
        let inserter = PxPhysics_getPhysicsInsertionCallback_mut(physics());
        phys_PxCreateTriangleMesh(&params, &desc, inserter, null_mut())
    }
}

impl Physx {
    unsafe fn add_level(&mut self, level: &Level, material: *mut PxMaterial) -> Result<(), String> {
        unsafe {
            let here = PxTransform_new_2(PxIDENTITY::PxIdentity);
            let actor = if let Some(b) = level.solid_box() {
                let plane = PxPlane_new_1(0.0, 0.0, 1.0, -b[5] as f32);
                phys_PxCreatePlane(physics(), &plane, material)
            } else {
                self.mesh = cook(level);
                if self.mesh.is_null() {
                    return Err("the triangles could not be cooked".into());
                }
                let flags = PxMeshGeometryFlags::empty();
                let shape = PxTriangleMeshGeometry_new(self.mesh, &PxMeshScale_new(), flags);
                phys_PxCreateStatic(physics(), &here, (&shape as *const PxTriangleMeshGeometry).cast(), material, &here)
            };
            PxScene_addActor_mut(self.scene, actor.cast(), null());
        }
        Ok(())
    }

    /// A manager each: within one, every move copies all controllers, and here nobody meets the others.
    unsafe fn add_walker(&mut self, who: &Character, material: *mut PxMaterial) -> Result<(), String> {
        unsafe {
            let manager = phys_PxCreateControllerManager(self.scene, false);
            let desc = PxCapsuleControllerDesc_new_alloc();
            (*desc).radius = who.radius as f32;
            (*desc).height = (2.0 * (who.half_height - who.radius)) as f32;
            (*desc).upDirection = PxVec3 { x: 0.0, y: 0.0, z: 1.0 };
            (*desc).slopeLimit = who.walkable_angle.cos() as f32;
            (*desc).stepOffset = who.step_height as f32;
            (*desc).material = material;
            let controller = PxControllerManager_createController_mut(manager, desc.cast());
            PxCapsuleControllerDesc_delete(desc);
            if controller.is_null() {
                return Err("no controller: its description is refused".into());
            }
            self.walkers.push(Walker { manager, controller, rise: 0.0, grounded: false });
        }
        Ok(())
    }

    fn position(&self, i: usize) -> [f64; 3] {
        let p = unsafe { &*PxController_getPosition(self.walkers[i].controller) };
        [p.x, p.y, p.z]
    }
}

impl Controller for Physx {
    fn open(level: &Level, who: &Character, count: u32) -> Result<Self, String> {
        if level.planar != 0 {
            return Err("three dimensions only".into());
        }
        unsafe {
            if physics().is_null() {
                return Err("PhysX does not start".into());
            }
            let wait = PxDefaultCpuDispatcherWaitForWorkMode::WaitForWork;
            let dispatcher = phys_PxDefaultCpuDispatcherCreate(0, null_mut(), wait, 0);
            let mut filters = PxControllerFilters_new(null(), null_mut(), null_mut());
            filters.mFilterFlags = PxQueryFlags::Static;
            let mut made = Physx {
                dispatcher,
                scene: make_scene(dispatcher, who.gravity as f32),
                mesh: null_mut(),
                filters,
                walkers: Vec::new(),
                dt: who.dt as f32,
                gravity: who.gravity as f32,
                jump_speed: who.jump_speed as f32,
            };
            let material = PxPhysics_createMaterial_mut(physics(), 0.5, 0.5, 0.0);
            made.add_level(level, material)?;
            for _ in 0..count {
                made.add_walker(who, material)?;
            }
            Ok(made)
        }
    }

    fn place(&mut self, i: usize, position: [f64; 3]) {
        let walker = &mut self.walkers[i];
        let to = PxExtendedVec3 { x: position[0], y: position[1], z: position[2] };
        unsafe { PxController_setPosition_mut(walker.controller, &to) };
        walker.rise = 0.0;
        walker.grounded = false;
    }

    fn step(&mut self, i: usize, wish: [f64; 3], jump: bool) {
        let dt = self.dt;
        let walker = &mut self.walkers[i];
        if walker.grounded {
            walker.rise = if jump { self.jump_speed } else { 0.0 };
        }
        walker.rise -= self.gravity * dt;
        let way = PxVec3 { x: dt * wish[0] as f32, y: dt * wish[1] as f32, z: dt * walker.rise };
        let flags = unsafe { PxController_move_mut(walker.controller, &way, MIN_DISTANCE, dt, &self.filters, null()) };
        walker.grounded = flags.contains(PxControllerCollisionFlags::CollisionDown);
        if flags.contains(PxControllerCollisionFlags::CollisionUp) {
            walker.rise = walker.rise.min(0.0);
        }
    }

    fn look(&self, i: usize) -> Place {
        let walker = &self.walkers[i];
        Place {
            position: self.position(i),
            velocity: [0.0, 0.0, walker.rise as f64],
            grounded: walker.grounded as i32,
            queries: 0,
        }
    }
}

impl Drop for Physx {
    fn drop(&mut self) {
        unsafe {
            for walker in &self.walkers {
                PxControllerManager_release_mut(walker.manager);
            }
            PxScene_release_mut(self.scene);
            if !self.mesh.is_null() {
                PxTriangleMesh_release_mut(self.mesh);
            }
            PxDefaultCpuDispatcher_release_mut(self.dispatcher);
        }
    }
}

static PHYSX: Method = method_of::<Physx>(
    "physx\0",
    concat!("5.1.3 (physx-sys 0.11.5)", "\0"),
    "PxCapsuleController with the defaults of its description (contact offset 0.1, volume growth 1.5, easy climbing); \
     static bodies only and a manager a character, so that none is copied for others; single precision with double \
     positions, AVX2; plane as PxPlane; triangles block from the front only\0",
);

#[no_mangle]
pub extern "C" fn method_physx() -> *const Method {
    &PHYSX
}
