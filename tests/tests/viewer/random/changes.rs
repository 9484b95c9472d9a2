//! What a hand gives a value.

use super::hand::Hand;
use oktant_shared::parts::{Parts, TraversalKind};

impl Hand {
    /// Another structure, triangle test or box test.
    pub(super) fn parts(&mut self) {
        let traversal = self.traversal;
        let offered: Vec<&Parts> = Parts::OFFERED
            .iter()
            .filter(|parts| parts.traversal == traversal)
            .collect();
        let parts = offered[self.random.usize(0..offered.len())];
        match self.random.u32(0..4) {
            0 => self.does(format!("set triangle {}", parts.triangle)),
            1 => self.does(format!("set box {}", parts.box_test)),
            2 => {
                let preset = self.one(&["fast", "balanced", "quality"]);
                self.does(format!("set build {preset}"));
            }
            _ => {
                // Without a structure, large scenes last; with compact triangles, mirrors that a file lacks are rougher.
                let all = [
                    TraversalKind::Octants,
                    TraversalKind::Octree,
                    TraversalKind::Bvh2,
                    TraversalKind::Grid,
                ];
                self.traversal = all[self.random.usize(0..all.len())];
                self.does(format!("set traversal {}", self.traversal));
            }
        }
    }

    pub(super) fn sets(&mut self) {
        match self.random.u32(0..5) {
            0 => self.sets_light(),
            1 => self.sets_material(),
            2 => self.sets_surroundings(),
            3 => self.sets_camera(),
            _ => self.sets_picture(),
        }
    }

    fn sets_picture(&mut self) {
        let setting = match self.random.u32(0..13) {
            0 => format!("samples {}", self.one(&["1", "4", "16", "adaptive:4", "adaptive:16"])),
            1 => format!("error {}", self.number(0.001, 0.1)),
            2 => format!("block {}", self.one(&["1", "2", "4", "8"])),
            3 => format!("pattern {}", self.one(&["regular", "rotated", "r2"])),
            4 => format!("filter {}", self.one(&["box", "tent", "gaussian"])),
            5 => format!("shading {}", self.one(&["flat", "phong"])),
            6 => format!("depth {}", self.random.u32(0..=16)),
            7 => format!("cutoff {}", self.one(&["0", "0.5", "4"])),
            8 => format!("light-azimuth {}", self.number(-180.0, 180.0)),
            9 => format!("light-elevation {}", self.number(-90.0, 90.0)),
            10 => format!("light-distance {}", self.number(0.5, 8.0)),
            11 => format!("exposure {}", self.number(-2.0, 2.0)),
            _ => format!("tone {}", self.one(&["none", "reinhard", "aces"])),
        };
        self.does(format!("set {setting}"));
    }

    fn sets_camera(&mut self) {
        let setting = match self.random.u32(0..7) {
            0 => format!("azimuth {}", self.number(-180.0, 180.0)),
            1 => format!("elevation {}", self.number(-90.0, 90.0)),
            2 => format!("distance {}", self.number(0.5, 8.0)),
            3 => format!("fov {}", self.number(10.0, 120.0)),
            4 => format!("target {}", self.three(-1.0, 1.0)),
            5 => return self.sees_parallel(),
            _ => {
                let mode = self.one(&["anaglyph", "rows", "side-by-side", "sequential"]);
                return self.parts_eyes(mode);
            }
        };
        self.does(format!("set {setting}"));
    }

    /// One eye without perspective.
    pub(super) fn sees_parallel(&mut self) {
        self.does("set stereo none");
        self.does("set projection orthographic");
        let height = self.number(0.5, 8.0);
        self.does(format!("set ortho-height {height}"));
    }

    /// Two eyes, which have perspective.
    pub(super) fn parts_eyes(&mut self, mode: &str) {
        self.does("set projection perspective");
        self.does(format!("set stereo {mode}"));
        let length = self.one(&["eye-distance", "convergence"]);
        let units = self.number(0.01, 3.0);
        self.does(format!("set {length} {units}"));
    }

    fn sets_light(&mut self) {
        if self.lights == 0 || (self.lights < 4 && self.random.u32(0..6) == 0) {
            self.lights += 1;
            return self.does("add light");
        }
        let index = self.random.usize(0..self.lights);
        if self.random.u32(0..8) == 0 {
            self.lights -= 1;
            return self.does(format!("remove light {index}"));
        }
        let setting = match self.random.u32(0..8) {
            // Powers of two, and colours whose greatest channel is 1, come back exactly when they are written down.
            0 => format!("color 1,{},{}", self.number(0.0, 1.0), self.number(0.0, 1.0)),
            1 => format!("intensity {}", self.one(&["0", "0.5", "1", "2"])),
            2 => format!("position {}", self.three(-5.0, 5.0)),
            3 => format!("azimuth {}", self.number(-180.0, 180.0)),
            4 => format!("elevation {}", self.number(-90.0, 90.0)),
            5 => format!("range {}", self.one(&["0", "3", "20"])),
            6 => format!("falloff {}", self.one(&["none", "inverse-square"])),
            _ => format!("radius {}", self.number(0.01, 1.0)),
        };
        self.does(format!("set light {index} {setting}"));
    }

    fn sets_material(&mut self) {
        let index = self.random.usize(0..self.materials);
        let setting = match self.random.u32(0..14) {
            0 => format!("base {}", self.three(0.0, 1.0)),
            1 => format!("ambient {}", self.number(0.0, 1.0)),
            2 => format!("diffuse {}", self.number(0.0, 1.0)),
            3 => format!("specular {}", self.three(0.0, 1.0)),
            4 => format!("exponent {}", self.number(1.0, 200.0)),
            5 => format!("mirror {}", self.three(0.0, 1.0)),
            6 => format!("transmission {}", self.three(0.0, 1.0)),
            7 => format!("ior {}", self.number(0.5, 3.0)),
            8 => format!("absorption {}", self.three(0.0, 2.0)),
            9 => format!("priority {}", self.random.u32(0..5)),
            10 => format!("bump_height {}", self.number(-0.1, 0.1)),
            11 => format!("fresnel {}", self.one(&["on", "off"])),
            12 => format!("smooth {}", self.one(&["on", "off"])),
            _ => format!("highlight {}", self.one(&["blinn", "phong"])),
        };
        self.does(format!("set material {index} {setting}"));
    }

    fn sets_surroundings(&mut self) {
        let name = self.one(&["color", "zenith", "horizon", "nadir", "ambient"]);
        let color = self.three(0.0, 1.0);
        self.does(format!("set environment {name} {color}"));
    }
}
