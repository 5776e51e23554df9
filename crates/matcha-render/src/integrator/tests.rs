//! Russian roulette, played many times.

use super::path::path_settings;
use super::*;
use crate::device::path_flags::{PATH_ENDS, PATH_SURVIVED};
use crate::device::path_state::{ScatterKind, path_survival};
use crate::device::path_step::{
    PathTurn, path_pass_through, path_reaches, path_scatter, path_survive,
};
use crate::scene::{Camera, PixelFilter, Settings};

/// Games of a test.
const GAMES: u32 = 1 << 14;
/// What the paths carry; √0.3 of them survive.
const THROUGHPUT: Vec3 = Vec3::new(0.1, 0.3, 0.2);

/// Sample `index` of a pixel after a number of glossy bounces, with a throughput.
fn path_after(bounces: u32, throughput: Vec3, index: u32) -> Path {
    let camera = crate::camera::prepare(&Camera::default(), [8, 8], 1.0);
    let filter = FilterTable::new(PixelFilter::Box);
    let mut path = path_start(camera, filter.view(), 7, 3, 4, 0, index);
    for _ in 0..bounces {
        assert!(path_scatter(&mut path, Vec3::ONE, turn(false), rules(0)));
    }
    path.throughput = throughput;
    path
}

/// Straight up from the origin.
fn turn(diffuse: bool) -> PathTurn {
    PathTurn {
        position: Vec3::ZERO,
        true_normal: Vec3::Z,
        selection_normal: Vec3::Z,
        cone_width: 0.0,
        cone_spread: 0.0,
        leaves: [0, 0],
        wi: Vec3::Z,
        pdf: 1.0,
        kind: ScatterKind {
            diffuse,
            singular: false,
            transmit: false,
        },
    }
}

fn rules(min_bounces: u32) -> PathSettings {
    path_settings(&Settings {
        min_bounces,
        ..Settings::default()
    })
}

/// What is left of a path at a surface where roulette has been played.
fn after_a_surface(mut path: Path, settings: PathSettings) -> Option<Vec3> {
    path_reaches(&mut path, false, settings).then(|| {
        let survival = path_survival(&path, settings);
        path_survive(&mut path, survival);
        path.throughput
    })
}

/// The mean of what is left of all paths must be what they carried.
fn check_mean(left: impl Fn(u32) -> Option<Vec3>) {
    let left: Vec<Vec3> = (0..GAMES).filter_map(left).collect();
    let sum: Vec3 = left.iter().sum();
    let mean = sum / GAMES as f32;
    let survival = THROUGHPUT.max_element().sqrt();
    let deviation = ((1.0 - survival) / survival / GAMES as f32).sqrt();
    assert!(left.len() < GAMES as usize, "somebody loses");
    assert!(
        ((mean - THROUGHPUT) / THROUGHPUT).abs().max_element() < 3.0 * deviation,
        "{mean}"
    );
}

#[test]
fn survivors_carry_the_light_of_all() {
    check_mean(|index| after_a_surface(path_after(2, THROUGHPUT, index), rules(0)));
    check_mean(|index| {
        let mut path = path_after(1, Vec3::ONE, index);
        path_scatter(&mut path, THROUGHPUT, turn(true), rules(0)).then_some(path.throughput)
    });
}

#[test]
fn paths_that_end_stay_for_emission() {
    let mut ended = 0;
    for index in 0..GAMES {
        let path = path_after(2, THROUGHPUT, index);
        let [mut dark, mut bright] = [path; 2];
        let lives = path_reaches(&mut dark, false, rules(0));
        assert!(path_reaches(&mut bright, true, rules(0)));
        // The draw is the same.
        let ends = (bright.flags & PATH_ENDS) != 0;
        assert_eq!(lives, !ends);
        assert_eq!(bright.throughput, THROUGHPUT);
        ended += u32::from(ends);
    }
    let expected = (1.0 - THROUGHPUT.max_element().sqrt()) * GAMES as f32;
    assert!((ended as f32 - expected).abs() < 0.02 * expected, "{ended}");
}

#[test]
fn nobody_plays_before_the_second_bounce_or_later_if_asked() {
    let dim = Vec3::splat(1e-12);
    for min_bounces in [0, 3] {
        let settings = rules(min_bounces);
        assert_eq!(settings.roulette_bounce, min_bounces + 2);
        for bounces in 0..settings.roulette_bounce {
            for index in 0..64 {
                let path = path_after(bounces, dim, index);
                assert_eq!(after_a_surface(path, settings), Some(dim));
            }
        }
        let lives =
            |&i: &u32| after_a_surface(path_after(min_bounces + 2, dim, i), settings).is_some();
        assert_eq!((0..64).find(lives), None);
    }
    assert_eq!(rules(u32::MAX).roulette_bounce, u32::MAX);
}

#[test]
fn a_path_plays_once_a_scattering() {
    let settings = rules(0);
    let dim = Vec3::splat(1e-12);
    for index in 0..64 {
        let mut path = path_after(2, THROUGHPUT, index);
        let survival = path_survival(&path, settings);
        assert_eq!(survival, THROUGHPUT.max_element().sqrt());
        path_survive(&mut path, survival);
        // At the next surface too, if the path goes straight through this one.
        path.throughput = dim;
        assert_eq!(after_a_surface(path, settings), Some(dim));
        assert!(path_pass_through(
            &mut path,
            Vec3::ONE,
            [0, 0],
            1.0,
            settings
        ));
        assert_eq!(after_a_surface(path, settings), Some(dim));
        // A glossy scattering is followed by a new game, a diffuse one was one.
        let mut diffuse = path;
        path_scatter(&mut path, Vec3::ONE, turn(false), settings);
        assert_eq!(path.flags & PATH_SURVIVED, 0);
        assert_eq!(after_a_surface(path, settings), None);
        diffuse.throughput = Vec3::ONE;
        assert!(path_scatter(&mut diffuse, Vec3::ONE, turn(true), settings));
        assert_ne!(diffuse.flags & PATH_SURVIVED, 0);
        assert_eq!(path_survival(&diffuse, settings), 1.0);
    }
}
