// SPDX-License-Identifier: MIT
//! tests/bench/method.h, as Rust sees it. The two are changed together.
use std::ffi::{c_char, c_int, c_void};
use std::panic::{catch_unwind, AssertUnwindSafe};

pub const METHOD_ERROR: usize = 256;

#[repr(C)]
pub struct Level {
    pub name: *const c_char,
    pub vertices: *const f64,
    pub indices: *const u32,
    pub vertex_count: u32,
    pub triangle_count: u32,
    pub planar: c_int,
    pub solid_box: *const f64,
}

#[repr(C)]
pub struct Character {
    pub radius: f64,
    pub half_height: f64,
    pub max_speed: f64,
    pub jump_speed: f64,
    pub gravity: f64,
    pub step_height: f64,
    pub walkable_angle: f64,
    pub dt: f64,
}

#[repr(C)]
#[derive(Default)]
pub struct Place {
    pub position: [f64; 3],
    pub velocity: [f64; 3],
    pub grounded: i32,
    pub queries: u32,
}

type Open = unsafe extern "C" fn(*const Method, *const Level, *const Character, u32, *mut c_char) -> *mut c_void;

#[repr(C)]
pub struct Method {
    pub name: *const c_char,
    pub version: *const c_char,
    pub settings: *const c_char,
    pub open: Open,
    pub close: unsafe extern "C" fn(*mut c_void),
    pub place: unsafe extern "C" fn(*mut c_void, u32, *const f64),
    pub step: unsafe extern "C" fn(*mut c_void, u32, *const f64, c_int),
    pub look: unsafe extern "C" fn(*mut c_void, u32, *mut Place),
    pub data: *const c_void,
}

// Nothing in it is ever written.
unsafe impl Sync for Method {}

/// A controller as safe code; `method_of` makes the C table of one.
pub trait Controller: Sized {
    fn open(level: &Level, who: &Character, count: u32) -> Result<Self, String>;
    fn place(&mut self, i: usize, position: [f64; 3]);
    fn step(&mut self, i: usize, wish: [f64; 3], jump: bool);
    fn look(&self, i: usize) -> Place;
}

impl Level {
    pub fn vertex(&self, i: u32) -> [f64; 3] {
        let at = 3 * i as usize;
        let all = unsafe { std::slice::from_raw_parts(self.vertices, 3 * self.vertex_count as usize) };
        [all[at], all[at + 1], all[at + 2]]
    }

    pub fn triangles(&self) -> &[u32] {
        unsafe { std::slice::from_raw_parts(self.indices, 3 * self.triangle_count as usize) }
    }

    /// Low and high corner of the solid box with the same ground.
    pub fn solid_box(&self) -> Option<[f64; 6]> {
        unsafe { self.solid_box.cast::<[f64; 6]>().as_ref().copied() }
    }
}

/// Whoever panics in a step stands at no number from then on, until it is placed anew: the judge counts that.
struct Guarded<T> {
    controller: T,
    failed: Vec<bool>,
}

unsafe extern "C" fn open<T: Controller>(
    _: *const Method,
    level: *const Level,
    who: *const Character,
    count: u32,
    error: *mut c_char,
) -> *mut c_void {
    let made = catch_unwind(|| unsafe { T::open(&*level, &*who, count) });
    match made.unwrap_or_else(|_| Err("it panics while it is opened".into())) {
        Ok(controller) => {
            let failed = vec![false; count as usize];
            Box::into_raw(Box::new(Guarded { controller, failed })).cast()
        }
        Err(why) => {
            let text = &why.as_bytes()[..why.len().min(METHOD_ERROR - 1)];
            unsafe {
                std::ptr::copy_nonoverlapping(text.as_ptr().cast(), error, text.len());
                *error.add(text.len()) = 0;
            }
            std::ptr::null_mut()
        }
    }
}

unsafe extern "C" fn close<T: Controller>(this: *mut c_void) {
    drop(unsafe { Box::from_raw(this.cast::<Guarded<T>>()) });
}

unsafe extern "C" fn place<T: Controller>(this: *mut c_void, i: u32, position: *const f64) {
    let this = unsafe { &mut *this.cast::<Guarded<T>>() };
    this.failed[i as usize] = false;
    this.controller.place(i as usize, unsafe { *position.cast() });
}

unsafe extern "C" fn step<T: Controller>(this: *mut c_void, i: u32, wish: *const f64, jump: c_int) {
    let this = unsafe { &mut *this.cast::<Guarded<T>>() };
    let (controller, wish) = (&mut this.controller, unsafe { *wish.cast() });
    if catch_unwind(AssertUnwindSafe(|| controller.step(i as usize, wish, jump != 0))).is_err() {
        this.failed[i as usize] = true;
    }
}

unsafe extern "C" fn look<T: Controller>(this: *mut c_void, i: u32, out: *mut Place) {
    let this = unsafe { &*this.cast::<Guarded<T>>() };
    let mut place = this.controller.look(i as usize);
    if this.failed[i as usize] {
        place.position = [f64::NAN; 3];
    }
    unsafe { *out = place };
}

/// The three texts end in a zero byte.
pub const fn method_of<T: Controller>(name: &'static str, version: &'static str, settings: &'static str) -> Method {
    Method {
        name: name.as_ptr().cast(),
        version: version.as_ptr().cast(),
        settings: settings.as_ptr().cast(),
        open: open::<T>,
        close: close::<T>,
        place: place::<T>,
        step: step::<T>,
        look: look::<T>,
        data: std::ptr::null(),
    }
}
