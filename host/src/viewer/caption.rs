//! What the overlay says.

use super::overlay::{Line, Tone, wrap};
use crate::stereo::StereoMode;
use crate::tone::{self, Curve};
use clap::ValueEnum;

/// What every key and every drag does.
const HELP: [(&str, &str); 23] = [
    ("left, right drag", "turn the camera, the light"),
    ("middle, Shift+drag", "pan"),
    ("wheel", "come closer, go away"),
    ("double click, F", "fit everything into the window"),
    ("R", "back to the first view"),
    ("W A S D Q E, G", "fly, circle what is there"),
    ("X Y Z, with Shift", "look along an axis, from behind"),
    ("Shift+P, J K", "perspective or not, narrower, wider"),
    ("1 - 9, Ctrl+1 - 9", "saved views, save one"),
    ("Ctrl+C, with Shift", "copy the camera: options, TOML"),
    ("P, M, . ,", "flat or Phong, samples, reflections"),
    ("T, + -", "next tone curve, brighter, darker"),
    ("L, ] [", "stereo, eyes farther apart, nearer"),
    ("I, Tab, H", "figures, panel, this list on or off"),
    ("/", "type what is to be set"),
    ("B, O", "CPU or GPU, compare with the oracle"),
    ("V, with Shift", "what pixels cost: next, previous"),
    ("C > <", "cells of the structure, their level"),
    ("Ctrl+click, Ctrl+Shift", "pin a ray, show a material"),
    ("Ctrl+S", "save the picture"),
    ("Ctrl+O, with Shift", "open files, beside these"),
    ("drop files, Ctrl+R", "open them, list recent files"),
    ("Esc", "circle, unpin, quit"),
];

/// What the figures are about.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Caption {
    /// New pictures a second, if anything moves.
    pub frames_a_second: Option<f64>,
    /// Milliseconds of the last pass.
    pub kernel: Option<f64>,
    /// Millions of camera rays a second.
    pub megarays_a_second: Option<f64>,
    /// Triangles of the mesh.
    pub triangles: Option<usize>,
    /// Size of the window's picture.
    pub size: [u32; 2],
    /// Samples a pixel that are wanted, and taken.
    pub samples: [u32; 2],
    /// Whether normals are interpolated.
    pub phong: bool,
    /// How many times a ray may be reflected or refracted.
    pub depth: u32,
    /// How the light is made to fit the screen.
    pub tone: tone::Tone,
    /// From the lower edge of the picture to the upper one, scene units, where rays are parallel.
    pub parallel: Option<f32>,
    /// How fast the camera flies, scene units a second, if it does.
    pub flight: Option<f32>,
    /// How two eyes share the screen, and their distance in scene units.
    pub stereo: Option<(StereoMode, f32)>,
    /// What renders.
    pub backend: String,
    /// What is being loaded and what is being saved, and how far it is.
    pub under_way: Vec<String>,
}

/// The panel of figures.
pub fn figures(caption: &Caption) -> Vec<Line> {
    let speed = [
        match caption.frames_a_second {
            Some(rate) => format!("{} frames/s", digits(rate)),
            None => "idle".into(),
        },
        caption.kernel.map_or_else(String::new, |milliseconds| {
            format!("kernel {} ms", digits(milliseconds))
        }),
        caption
            .megarays_a_second
            .map_or_else(String::new, |rate| format!("{} Mrays/s", digits(rate))),
    ];
    let [wanted, taken] = caption.samples;
    let samples = match (wanted, taken) {
        (1, _) => "1 sample".into(),
        (wanted, taken) if taken < wanted => format!("{taken} of {wanted} samples"),
        (wanted, _) => format!("{wanted} samples"),
    };
    let mesh = [
        caption
            .triangles
            .map_or_else(String::new, |triangles| format!("{} triangles", grouped(triangles))),
        format!("{} \u{d7} {}", caption.size[0], caption.size[1]),
        samples,
        if caption.phong { "Phong" } else { "flat" }.into(),
        format!("depth {}", caption.depth),
    ];
    let tone::Tone { exposure, curve } = caption.tone;
    let screen = [
        caption
            .flight
            .map_or_else(String::new, |speed| format!("flying, {} units/s", significant(speed))),
        caption.parallel.map_or_else(String::new, |height| {
            format!("orthographic, {} high", significant(height))
        }),
        if curve == Curve::None {
            String::new()
        } else {
            format!("tone {}", name(&curve))
        },
        if exposure == 0.0 {
            String::new()
        } else {
            format!("{exposure:+.1} stops")
        },
        caption.stereo.map_or_else(String::new, |(mode, distance)| {
            format!("{}, eyes {} apart", name(&mode), significant(distance))
        }),
    ];
    let mut lines = vec![
        plain(joined(&[
            caption.backend.clone(),
            "H: keys".into(),
            "Tab: panel".into(),
        ])),
        strong(joined(&speed)),
        plain(joined(&mesh)),
    ];
    lines.extend(Some(joined(&screen)).filter(|line| !line.is_empty()).map(plain));
    lines.extend(caption.under_way.iter().cloned().map(strong));
    lines
}

/// The panel of keys.
pub fn help() -> Vec<Line> {
    let width = HELP.iter().map(|(key, _)| key.len()).max().unwrap_or(0);
    HELP.iter()
        .map(|(key, meaning)| plain(format!("{key:<width$}   {meaning}")))
        .collect()
}

/// The panel of a message.
pub fn message(text: &str, is_warning: bool, columns: usize) -> Vec<Line> {
    let tone = if is_warning { Tone::Warning } else { Tone::Strong };
    wrap(text, columns)
        .into_iter()
        .map(|text| Line { text, tone })
        .collect()
}

fn plain(text: String) -> Line {
    Line {
        text,
        tone: Tone::Plain,
    }
}

fn strong(text: String) -> Line {
    Line {
        text,
        tone: Tone::Strong,
    }
}

fn joined(parts: &[String]) -> String {
    let parts: Vec<&str> = parts
        .iter()
        .map(String::as_str)
        .filter(|part| !part.is_empty())
        .collect();
    parts.join("   ")
}

/// A number with three digits, or all before the point if there are more.
pub fn digits(number: f64) -> String {
    let decimals = if number >= 99.95 {
        0
    } else if number >= 9.995 {
        1
    } else {
        2
    };
    format!("{number:.decimals$}")
}

/// A length with three digits, whatever its size.
fn significant(length: f32) -> String {
    if (1e-3..1e4).contains(&length) {
        let decimals = (2 - length.log10().floor() as i32).max(0) as usize;
        format!("{length:.decimals$}")
    } else {
        format!("{length:.2e}")
    }
}

/// What the command line calls a value.
pub fn name(value: &impl ValueEnum) -> String {
    value
        .to_possible_value()
        .map_or_else(String::new, |value| value.get_name().into())
}

/// A number with its thousands apart.
pub fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::super::grammar::KEYS;
    use super::*;

    #[test]
    fn numbers() {
        for (number, text) in [
            (0.123, "0.12"),
            (1.5, "1.50"),
            (9.999, "10.0"),
            (99.96, "100"),
            (1234.5, "1234"),
        ] {
            assert_eq!(digits(number), text);
        }
        for (number, text) in [
            (0, "0"),
            (999, "999"),
            (1000, "1,000"),
            (69_451, "69,451"),
            (7_218_906, "7,218,906"),
        ] {
            assert_eq!(grouped(number), text);
        }
    }

    #[test]
    fn lengths() {
        for (length, text) in [
            (0.093_333, "0.0933"),
            (1.0, "1.00"),
            (99.99, "100.0"),
            (1234.5, "1234"),
            (1e-5, "1.00e-5"),
            (123_456.0, "1.23e5"),
        ] {
            assert_eq!(significant(length), text);
        }
    }

    #[test]
    fn the_figures() {
        let caption = Caption {
            frames_a_second: Some(59.94),
            kernel: Some(1.5),
            megarays_a_second: Some(826.0),
            triangles: Some(69_451),
            size: [1280, 968],
            samples: [4, 4],
            phong: true,
            depth: 5,
            tone: tone::Tone::default(),
            parallel: None,
            flight: None,
            stereo: None,
            backend: "CPU, 2 threads".into(),
            under_way: Vec::new(),
        };
        let text = |caption: &Caption| figures(caption).into_iter().map(|line| line.text).collect::<Vec<_>>();
        assert_eq!(
            text(&caption),
            [
                "CPU, 2 threads   H: keys   Tab: panel",
                "59.9 frames/s   kernel 1.50 ms   826 Mrays/s",
                "69,451 triangles   1280 \u{d7} 968   4 samples   Phong   depth 5",
            ]
        );
        let waiting = Caption {
            under_way: vec!["reading a.ply: 40 %".into(), "saving b.png: 5 %".into()],
            samples: [16, 7],
            tone: tone::Tone {
                exposure: -1.0 / 3.0,
                curve: Curve::Aces,
            },
            stereo: Some((StereoMode::SideBySide, 0.093_333)),
            ..Caption::default()
        };
        let flying = Caption {
            flight: Some(0.5),
            parallel: Some(12.5),
            ..Caption::default()
        };
        assert_eq!(text(&flying)[3], "flying, 0.500 units/s   orthographic, 12.5 high");
        assert_eq!(
            text(&waiting)[1..],
            [
                "idle",
                "0 \u{d7} 0   7 of 16 samples   flat   depth 0",
                "tone aces   -0.3 stops   side-by-side, eyes 0.0933 apart",
                "reading a.ply: 40 %",
                "saving b.png: 5 %",
            ]
        );
    }

    #[test]
    fn every_key_is_listed() {
        let help: Vec<String> = help().into_iter().map(|line| line.text).collect();
        let has = |line: &str, key: &str| {
            line.split(' ')
                .any(|word| word == key || word.strip_suffix(',') == Some(key))
        };
        // Others do the same as these.
        let is_other = |key: &&str| ["=", "?", "Escape", "Ctrl+9"].contains(key) || key.contains("Keypad");
        for key in KEYS.into_iter().filter(|key| !is_other(key)) {
            let bare = key.replace("Shift+", "");
            let is_with_shift = |line: &str| bare != key && has(line, &bare) && line.contains("with Shift");
            assert!(
                help.iter().any(|line| has(line, key) || is_with_shift(line)),
                "{key} in {help:#?}"
            );
        }
    }
}
