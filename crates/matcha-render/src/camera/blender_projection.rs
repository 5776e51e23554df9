//! Written by `blender/tests/camera_reference.py`; Blender 4.5.15 LTS.
use super::tests::Case;
use crate::scene::SensorFit::{Auto, Horizontal, Vertical};

/// Columns of the camera's matrix.
#[rustfmt::skip]
pub const MATRIX: [[f32; 3]; 4] = [
    [0.93467975, 0.34118474, -0.09983342],
    [-0.0368443, 0.37229511, 0.92738277],
    [0.35357636, -0.86312765, 0.36054742],
    [1.5, -4.0, 2.25],
];
/// Points in the world.
#[rustfmt::skip]
pub const POINTS: [[f32; 3]; 3] = [[0.1, 0.3, 0.2], [-0.8, 1.0, 0.5], [0.7, -0.4, 1.9]];
/// Pixels from the top left at which each camera sees the points.
#[rustfmt::skip]
pub const CASES: &[Case] = &[
    Case { parallel: false, fit: Auto, size: [640, 360], aspect: 1.0, shift: [0.0, 0.0], fitted: 0.457143, pixels: [[371.408, 215.199], [287.292, 140.709], [422.614, -28.061]] },
    Case { parallel: false, fit: Auto, size: [640, 360], aspect: 1.0, shift: [0.15, -0.3], fitted: 0.457143, pixels: [[275.408, 23.199], [191.292, -51.291], [326.614, -220.061]] },
    Case { parallel: false, fit: Auto, size: [640, 360], aspect: 2.0, shift: [0.0, 0.0], fitted: 0.457143, pixels: [[371.408, 250.398], [287.292, 101.418], [422.614, -236.122]] },
    Case { parallel: false, fit: Auto, size: [640, 360], aspect: 2.0, shift: [0.15, -0.3], fitted: 0.457143, pixels: [[275.408, -133.602], [191.292, -282.582], [326.614, -620.122]] },
    Case { parallel: false, fit: Auto, size: [360, 640], aspect: 1.0, shift: [0.0, 0.0], fitted: 0.457143, pixels: [[231.408, 355.199], [147.292, 280.709], [282.614, 111.939]] },
    Case { parallel: false, fit: Auto, size: [360, 640], aspect: 1.0, shift: [0.15, -0.3], fitted: 0.457143, pixels: [[135.408, 163.199], [51.292, 88.709], [186.614, -80.061]] },
    Case { parallel: false, fit: Auto, size: [360, 640], aspect: 2.0, shift: [0.0, 0.0], fitted: 0.457143, pixels: [[208.917, 359.599], [161.602, 275.798], [237.721, 85.931]] },
    Case { parallel: false, fit: Auto, size: [360, 640], aspect: 2.0, shift: [0.15, -0.3], fitted: 0.457143, pixels: [[154.917, 143.599], [107.602, 59.798], [183.721, -130.069]] },
    Case { parallel: false, fit: Horizontal, size: [640, 360], aspect: 1.0, shift: [0.0, 0.0], fitted: 0.457143, pixels: [[371.408, 215.199], [287.292, 140.709], [422.614, -28.061]] },
    Case { parallel: false, fit: Horizontal, size: [640, 360], aspect: 1.0, shift: [0.15, -0.3], fitted: 0.457143, pixels: [[275.408, 23.199], [191.292, -51.291], [326.614, -220.061]] },
    Case { parallel: false, fit: Horizontal, size: [640, 360], aspect: 2.0, shift: [0.0, 0.0], fitted: 0.457143, pixels: [[371.408, 250.398], [287.292, 101.418], [422.614, -236.122]] },
    Case { parallel: false, fit: Horizontal, size: [640, 360], aspect: 2.0, shift: [0.15, -0.3], fitted: 0.457143, pixels: [[275.408, -133.602], [191.292, -282.582], [326.614, -620.122]] },
    Case { parallel: false, fit: Horizontal, size: [360, 640], aspect: 1.0, shift: [0.0, 0.0], fitted: 0.457143, pixels: [[208.917, 339.799], [161.602, 297.899], [237.721, 202.966]] },
    Case { parallel: false, fit: Horizontal, size: [360, 640], aspect: 1.0, shift: [0.15, -0.3], fitted: 0.457143, pixels: [[154.917, 231.799], [107.602, 189.899], [183.721, 94.966]] },
    Case { parallel: false, fit: Horizontal, size: [360, 640], aspect: 2.0, shift: [0.0, 0.0], fitted: 0.457143, pixels: [[208.917, 359.599], [161.602, 275.798], [237.721, 85.931]] },
    Case { parallel: false, fit: Horizontal, size: [360, 640], aspect: 2.0, shift: [0.15, -0.3], fitted: 0.457143, pixels: [[154.917, 143.599], [107.602, 59.798], [183.721, -130.069]] },
    Case { parallel: false, fit: Vertical, size: [640, 360], aspect: 1.0, shift: [0.0, 0.0], fitted: 0.257143, pixels: [[371.408, 215.199], [287.292, 140.709], [422.614, -28.061]] },
    Case { parallel: false, fit: Vertical, size: [640, 360], aspect: 1.0, shift: [0.15, -0.3], fitted: 0.257143, pixels: [[317.408, 107.199], [233.292, 32.709], [368.614, -136.061]] },
    Case { parallel: false, fit: Vertical, size: [640, 360], aspect: 2.0, shift: [0.0, 0.0], fitted: 0.257143, pixels: [[345.704, 215.199], [303.646, 140.709], [371.307, -28.061]] },
    Case { parallel: false, fit: Vertical, size: [640, 360], aspect: 2.0, shift: [0.15, -0.3], fitted: 0.257143, pixels: [[318.704, 107.199], [276.646, 32.709], [344.307, -136.061]] },
    Case { parallel: false, fit: Vertical, size: [360, 640], aspect: 1.0, shift: [0.0, 0.0], fitted: 0.257143, pixels: [[271.392, 382.576], [121.853, 250.15], [362.426, -49.886]] },
    Case { parallel: false, fit: Vertical, size: [360, 640], aspect: 1.0, shift: [0.15, -0.3], fitted: 0.257143, pixels: [[175.392, 190.576], [25.853, 58.15], [266.426, -241.886]] },
    Case { parallel: false, fit: Vertical, size: [360, 640], aspect: 2.0, shift: [0.0, 0.0], fitted: 0.257143, pixels: [[225.696, 382.576], [150.926, 250.15], [271.213, -49.886]] },
    Case { parallel: false, fit: Vertical, size: [360, 640], aspect: 2.0, shift: [0.15, -0.3], fitted: 0.257143, pixels: [[177.696, 190.576], [102.926, 58.15], [223.213, -241.886]] },
    Case { parallel: true, fit: Auto, size: [640, 360], aspect: 1.0, shift: [0.0, 0.0], fitted: 7.500000, pixels: [[350.993, 201.221], [297.034, 152.412], [363.986, 90.814]] },
    Case { parallel: true, fit: Auto, size: [640, 360], aspect: 1.0, shift: [0.15, -0.3], fitted: 7.500000, pixels: [[254.993, 9.221], [201.034, -39.588], [267.986, -101.186]] },
    Case { parallel: true, fit: Auto, size: [640, 360], aspect: 2.0, shift: [0.0, 0.0], fitted: 7.500000, pixels: [[350.993, 222.442], [297.034, 124.824], [363.986, 1.627]] },
    Case { parallel: true, fit: Auto, size: [640, 360], aspect: 2.0, shift: [0.15, -0.3], fitted: 7.500000, pixels: [[254.993, -161.558], [201.034, -259.176], [267.986, -382.373]] },
    Case { parallel: true, fit: Auto, size: [360, 640], aspect: 1.0, shift: [0.0, 0.0], fitted: 7.500000, pixels: [[210.993, 341.221], [157.034, 292.412], [223.986, 230.814]] },
    Case { parallel: true, fit: Auto, size: [360, 640], aspect: 1.0, shift: [0.15, -0.3], fitted: 7.500000, pixels: [[114.993, 149.221], [61.034, 100.412], [127.986, 38.814]] },
    Case { parallel: true, fit: Auto, size: [360, 640], aspect: 2.0, shift: [0.0, 0.0], fitted: 7.500000, pixels: [[197.434, 343.874], [167.082, 288.963], [204.742, 219.665]] },
    Case { parallel: true, fit: Auto, size: [360, 640], aspect: 2.0, shift: [0.15, -0.3], fitted: 7.500000, pixels: [[143.434, 127.874], [113.082, 72.963], [150.742, 3.665]] },
    Case { parallel: true, fit: Horizontal, size: [640, 360], aspect: 1.0, shift: [0.0, 0.0], fitted: 7.500000, pixels: [[350.993, 201.221], [297.034, 152.412], [363.986, 90.814]] },
    Case { parallel: true, fit: Horizontal, size: [640, 360], aspect: 1.0, shift: [0.15, -0.3], fitted: 7.500000, pixels: [[254.993, 9.221], [201.034, -39.588], [267.986, -101.186]] },
    Case { parallel: true, fit: Horizontal, size: [640, 360], aspect: 2.0, shift: [0.0, 0.0], fitted: 7.500000, pixels: [[350.993, 222.442], [297.034, 124.824], [363.986, 1.627]] },
    Case { parallel: true, fit: Horizontal, size: [640, 360], aspect: 2.0, shift: [0.15, -0.3], fitted: 7.500000, pixels: [[254.993, -161.558], [201.034, -259.176], [267.986, -382.373]] },
    Case { parallel: true, fit: Horizontal, size: [360, 640], aspect: 1.0, shift: [0.0, 0.0], fitted: 7.500000, pixels: [[197.434, 331.937], [167.082, 304.482], [204.742, 269.833]] },
    Case { parallel: true, fit: Horizontal, size: [360, 640], aspect: 1.0, shift: [0.15, -0.3], fitted: 7.500000, pixels: [[143.434, 223.937], [113.082, 196.482], [150.742, 161.833]] },
    Case { parallel: true, fit: Horizontal, size: [360, 640], aspect: 2.0, shift: [0.0, 0.0], fitted: 7.500000, pixels: [[197.434, 343.874], [167.082, 288.963], [204.742, 219.665]] },
    Case { parallel: true, fit: Horizontal, size: [360, 640], aspect: 2.0, shift: [0.15, -0.3], fitted: 7.500000, pixels: [[143.434, 127.874], [113.082, 72.963], [150.742, 3.665]] },
    Case { parallel: true, fit: Vertical, size: [640, 360], aspect: 1.0, shift: [0.0, 0.0], fitted: 7.500000, pixels: [[337.434, 191.937], [307.082, 164.482], [344.742, 129.833]] },
    Case { parallel: true, fit: Vertical, size: [640, 360], aspect: 1.0, shift: [0.15, -0.3], fitted: 7.500000, pixels: [[283.434, 83.937], [253.082, 56.482], [290.742, 21.833]] },
    Case { parallel: true, fit: Vertical, size: [640, 360], aspect: 2.0, shift: [0.0, 0.0], fitted: 7.500000, pixels: [[328.717, 191.937], [313.541, 164.482], [332.371, 129.833]] },
    Case { parallel: true, fit: Vertical, size: [640, 360], aspect: 2.0, shift: [0.15, -0.3], fitted: 7.500000, pixels: [[301.717, 83.937], [286.541, 56.482], [305.371, 21.833]] },
    Case { parallel: true, fit: Vertical, size: [360, 640], aspect: 1.0, shift: [0.0, 0.0], fitted: 7.500000, pixels: [[210.993, 341.221], [157.034, 292.412], [223.986, 230.814]] },
    Case { parallel: true, fit: Vertical, size: [360, 640], aspect: 1.0, shift: [0.15, -0.3], fitted: 7.500000, pixels: [[114.993, 149.221], [61.034, 100.412], [127.986, 38.814]] },
    Case { parallel: true, fit: Vertical, size: [360, 640], aspect: 2.0, shift: [0.0, 0.0], fitted: 7.500000, pixels: [[195.497, 341.221], [168.517, 292.412], [201.993, 230.814]] },
    Case { parallel: true, fit: Vertical, size: [360, 640], aspect: 2.0, shift: [0.15, -0.3], fitted: 7.500000, pixels: [[147.497, 149.221], [120.517, 100.412], [153.993, 38.814]] },
];
