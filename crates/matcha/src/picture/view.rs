//! View transforms: from linear Rec.709 to what an sRGB display is sent.

use super::{agx, filmic};
use matcha_render::scene::ViewSettings;
use rayon::prelude::*;

/// The curve between scene and display.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Transform {
    /// Clipped, then IEC 61966-2-1.
    Standard,
    /// AgX as Blender ships it.
    Agx,
    /// Filmic as Blender ships it.
    Filmic,
    /// The numbers themselves, clipped.
    Raw,
}

/// A view transform with its exposure and gamma.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    transform: Transform,
    /// Factor before the curve.
    scale: f32,
    /// Exponent after it.
    exponent: f32,
}

impl View {
    /// The transform that a scene names; and in words what of it is not supported, which
    /// is replaced by Standard and by no look.
    pub fn new(settings: &ViewSettings) -> (Self, Option<String>) {
        let mut lacks = Vec::new();
        let transform = match settings.transform.as_str() {
            "Standard" => Transform::Standard,
            "AgX" => Transform::Agx,
            "Filmic" => Transform::Filmic,
            "Raw" => Transform::Raw,
            other => {
                lacks.push(format!(
                    "view transform \"{other}\" is not supported: Standard is used"
                ));
                Transform::Standard
            }
        };
        if !matches!(settings.look.as_str(), "None" | "") {
            lacks.push(format!(
                "look \"{}\" is not supported: none is used",
                settings.look
            ));
        }
        let scale = settings.exposure.clamp(-32.0, 32.0).exp2();
        let exponent = if settings.gamma > 0.0 {
            1.0 / settings.gamma
        } else {
            1.0
        };
        let lacks = (!lacks.is_empty()).then(|| lacks.join("; "));
        (
            Self {
                transform,
                scale,
                exponent,
            },
            lacks,
        )
    }

    /// The view of differences and other numbers for people: clipped sRGB.
    pub fn standard() -> Self {
        Self {
            transform: Transform::Standard,
            scale: 1.0,
            exponent: 1.0,
        }
    }

    /// What the display is sent, 0 to 1; not a number is black.
    pub fn display(&self, color: [f32; 3]) -> [f32; 3] {
        let exposed = color.map(|x| if x.is_nan() { 0.0 } else { x * self.scale });
        let shown = match self.transform {
            Transform::Standard => exposed.map(srgb),
            Transform::Agx => agx::display(exposed),
            Transform::Filmic => filmic::display(exposed),
            Transform::Raw => exposed,
        };
        shown.map(|x| {
            let x = x.clamp(0.0, 1.0);
            if self.exponent == 1.0 {
                x
            } else {
                x.powf(self.exponent)
            }
        })
    }

    /// In 8 bits.
    pub fn pixel(&self, color: [f32; 3]) -> [u8; 3] {
        self.display(color).map(|x| (x * 255.0 + 0.5) as u8)
    }

    /// A picture in 8 bits, three bytes a pixel; alpha is ignored, the picture stands on black.
    pub fn bytes(&self, pixels: &[[f32; 4]]) -> Vec<u8> {
        pixels
            .par_iter()
            .flat_map_iter(|&[r, g, b, _]| self.pixel([r, g, b]))
            .collect()
    }
}

/// The sRGB encoding, IEC 61966-2-1, of a linear value clipped to 0 to 1.
pub fn srgb(x: f32) -> f32 {
    let x = x.clamp(0.0, 1.0);
    if x <= 0.003_130_8 {
        12.92 * x
    } else {
        1.055 * x.powf(1.0 / 2.4) - 0.055
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A transform against a table of linear colours and of what Blender sends a display,
    /// 0 to 255: equal within 2, but for `strays` channels, which are within 5.
    pub(in crate::picture) fn check_reference(
        table: &str,
        display: impl Fn([f32; 3]) -> [f32; 3],
        strays: usize,
    ) {
        assert!(table.lines().count() > 500);
        let mut found = 0;
        for line in table.lines().skip(1) {
            let n: Vec<f32> = line.split(',').map(|x| x.parse().unwrap()).collect();
            let ours = display([n[0], n[1], n[2]]).map(|x| x.clamp(0.0, 1.0) * 255.0);
            for (ours, blender) in ours.iter().zip(&n[3..6]) {
                let error = (ours - blender).abs();
                found += usize::from(error > 2.0);
                assert!(error < 5.0 && found <= strays, "{line}: {ours}");
            }
        }
    }

    #[test]
    #[should_panic(expected = "0.5,0.5,0.5")]
    fn a_wrong_reference_is_noticed() {
        let table = "r,g,b,x,y,z\n".to_owned() + &"0.5,0.5,0.5,191,188,188\n".repeat(600);
        check_reference(&table, |color| color.map(srgb), 4);
    }

    fn settings(transform: &str) -> ViewSettings {
        ViewSettings {
            transform: transform.into(),
            ..ViewSettings::default()
        }
    }

    #[test]
    fn standard_is_srgb_with_exposure_and_gamma() {
        let view = View::new(&settings("Standard")).0;
        assert_eq!(view.pixel([0.0, 0.5, 1.0]), [0, 188, 255]);
        assert_eq!(view.pixel([-1.0, f32::NAN, f32::INFINITY]), [0, 0, 255]);
        let brighter = ViewSettings {
            exposure: 1.0,
            ..settings("Standard")
        };
        assert_eq!(View::new(&brighter).0.pixel([0.25; 3]), [188; 3]);
        let gamma = ViewSettings {
            gamma: 2.0,
            ..settings("Raw")
        };
        assert_eq!(View::new(&gamma).0.pixel([0.25; 3]), [128; 3]);
    }

    #[test]
    fn what_is_not_supported_is_said() {
        assert_eq!(View::new(&settings("AgX")).1, None);
        let (view, lacks) = View::new(&settings("False Color"));
        assert_eq!(view, View::standard());
        assert!(lacks.unwrap().contains("\"False Color\""));
        let look = ViewSettings {
            look: "AgX - Punchy".into(),
            ..settings("AgX")
        };
        assert!(View::new(&look).1.unwrap().contains("AgX - Punchy"));
    }
}
