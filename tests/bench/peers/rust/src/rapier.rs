// SPDX-License-Identifier: MIT
//! Rapier's KinematicCharacterController. It moves a shape by a translation and knows no velocity: gravity and jumps are
//! integrated here, as its documentation asks its users to.
use crate::method::{method_of, Character, Controller, Level, Method, Place};
use rapier3d::control::{CharacterAutostep, CharacterLength, KinematicCharacterController};
use rapier3d::parry::shape::Capsule;
use rapier3d::prelude::*;

#[derive(Clone, Default)]
struct Walker {
    position: Vector,
    moved: Vector,
    rise: f32,
    grounded: bool,
}

struct Rapier {
    bodies: RigidBodySet,
    colliders: ColliderSet,
    broad_phase: BroadPhaseBvh,
    narrow_phase: NarrowPhase,
    controller: KinematicCharacterController,
    shape: Capsule,
    walkers: Vec<Walker>,
    dt: f32,
    gravity: f32,
    jump_speed: f32,
}

fn vector(v: [f64; 3]) -> Vector {
    Vector::new(v[0] as f32, v[1] as f32, v[2] as f32)
}

fn collider(level: &Level) -> Result<Collider, String> {
    if let Some(b) = level.solid_box() {
        let ground = ColliderBuilder::new(SharedShape::halfspace(Vector::Z));
        return Ok(ground.translation(Vector::Z * b[5] as f32).build());
    }
    let vertices = (0..level.vertex_count).map(|i| vector(level.vertex(i))).collect();
    let triangles = level.triangles().chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
    let builder = ColliderBuilder::trimesh(vertices, triangles).map_err(|e| e.to_string())?;
    Ok(builder.build())
}

impl Controller for Rapier {
    fn open(level: &Level, who: &Character, count: u32) -> Result<Self, String> {
        if level.planar != 0 {
            return Err("three dimensions only (rapier2d is another crate)".into());
        }
        let controller = KinematicCharacterController {
            up: Vector::Z,
            autostep: Some(CharacterAutostep {
                max_height: CharacterLength::Absolute(who.step_height as f32),
                ..Default::default()
            }),
            max_slope_climb_angle: who.walkable_angle as f32,
            min_slope_slide_angle: who.walkable_angle as f32,
            ..Default::default()
        };
        let mut made = Rapier {
            bodies: RigidBodySet::new(),
            colliders: ColliderSet::new(),
            broad_phase: BroadPhaseBvh::new(),
            narrow_phase: NarrowPhase::new(),
            controller,
            shape: Capsule::new_z((who.half_height - who.radius) as f32, who.radius as f32),
            walkers: vec![Walker::default(); count as usize],
            dt: who.dt as f32,
            gravity: who.gravity as f32,
            jump_speed: who.jump_speed as f32,
        };
        made.colliders.insert(collider(level)?);
        CollisionPipeline::new().step(
            0.0,
            &mut IslandManager::new(),
            &mut made.broad_phase,
            &mut made.narrow_phase,
            &mut made.bodies,
            &mut made.colliders,
            &(),
            &(),
        );
        Ok(made)
    }

    fn place(&mut self, i: usize, position: [f64; 3]) {
        self.walkers[i] = Walker { position: vector(position), ..Default::default() };
    }

    fn step(&mut self, i: usize, wish: [f64; 3], jump: bool) {
        let walker = &mut self.walkers[i];
        if walker.grounded {
            walker.rise = if jump { self.jump_speed } else { 0.0 };
        }
        walker.rise -= self.gravity * self.dt;
        let way = self.dt * (vector(wish) + walker.rise * Vector::Z);
        let queries = self.broad_phase.as_query_pipeline(
            self.narrow_phase.query_dispatcher(),
            &self.bodies,
            &self.colliders,
            QueryFilter::default(),
        );
        let pose = Pose::from_translation(walker.position);
        let moved = self.controller.move_shape(self.dt, &queries, &self.shape, &pose, way, |_| {});
        walker.position += moved.translation;
        walker.moved = moved.translation;
        walker.grounded = moved.grounded;
        if walker.rise > 0.0 && moved.translation.z < 0.5 * way.z {
            walker.rise = 0.0; // a ceiling: the controller has no word for it
        }
    }

    fn look(&self, i: usize) -> Place {
        let walker = &self.walkers[i];
        let (p, v) = (walker.position, walker.moved / self.dt);
        Place {
            position: [p.x as f64, p.y as f64, p.z as f64],
            velocity: [v.x as f64, v.y as f64, v.z as f64],
            grounded: walker.grounded as i32,
            queries: 0,
        }
    }
}

static RAPIER: Method = method_of::<Rapier>(
    "rapier\0",
    "0.36.1\0",
    "KinematicCharacterController: offset 0.01 of the height, snap to ground 0.2 of it (both its defaults), autostep \
     on (its default is off: no steps), minimum width 0.5; single precision, AVX2; plane as a half space\0",
);

#[no_mangle]
pub extern "C" fn method_rapier() -> *const Method {
    &RAPIER
}
