//! All device modules of the workspace translate, and naga accepts them.

mod support;

use matcha_shade::ops;
use matcha_wgsl::{DispatchForm, Module, Problem, Source, check, translate};
use naga::valid::Capabilities;
use support::{device, device_modules, module, table};

#[test]
fn device_modules_and_operations_are_valid_wgsl() {
    let begin = std::time::Instant::now();
    let device = device(Vec::new());
    let operations = table(&device);
    let translated = begin.elapsed();
    let mut all = device.stand_ins();
    all.append(&device.source);
    all.append(&operations.source());
    all.append(&Source::written(
        "test.wgsl",
        "fn row(i: u32) -> f32 { return f32(i); }",
    ));
    all.append(&operations.dispatch(&DispatchForm {
        name: "execute",
        parameters: "immediate: u32",
        arguments: "immediate",
        operand: "row({}u)",
        immediate: "immediate",
    }));
    if let Ok(path) = std::env::var("MATCHA_WGSL_OUT") {
        std::fs::write(path, all.text()).expect("the path is writable");
    }
    let module = check(&all, Capabilities::empty()).unwrap_or_else(|e| panic!("{e}"));
    println!(
        "{} device functions, {} operations, {} lines of WGSL, {} functions in naga; \
         translated in {translated:?}, with naga {:?}",
        device.functions.len(),
        operations.entries.len(),
        all.text().lines().count(),
        module.functions.len(),
        begin.elapsed()
    );
    assert!(device.functions.len() > 300, "device modules are missing");

    let mut needed = device.needed(operations.functions()).source;
    let without_closures = needed.text().lines().count();
    assert!(without_closures < device.source.text().lines().count());
    needed.append(&operations.source());
    check(&needed, Capabilities::empty()).unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn the_table_is_the_one_that_the_processor_runs() {
    let operations = table(&device(Vec::new()));
    assert_eq!(operations.entries.len(), ops::all().count());
    for (entry, op) in operations.entries.iter().zip(ops::all()) {
        let info = op.info();
        assert_eq!((entry.name.as_str(), entry.code), (info.name, op.0));
        assert_eq!(entry.result.width(), info.result.width(), "{}", info.name);
        assert_eq!(entry.arguments.len(), info.arguments.len(), "{}", info.name);
        let rows: usize = entry.arguments.iter().map(|a| a.width()).sum();
        assert_eq!(rows, info.operand_rows(), "{}", info.name);
        assert_eq!(entry.is_loop, info.functions.len() == 4, "{}", info.name);
    }
}

#[test]
fn a_name_is_given_once() {
    let twice = Module {
        path: "crates/else/src/device/twice.rs".to_owned(),
        source: "\npub fn noise_3d(x: f32) -> f32 { x }".to_owned(),
    };
    let mut modules = device_modules();
    modules.push(twice);
    let error = translate(&modules).expect_err("the name is taken");
    let [only] = error.diagnostics.as_slice() else {
        panic!("{error}");
    };
    assert_eq!(only.place.to_string(), "crates/else/src/device/twice.rs:2");
    let Problem::Duplicate { name, first } = &only.problem else {
        panic!("{error}");
    };
    assert_eq!(name, "noise_3d");
    assert!(first.path.ends_with("device/perlin.rs"), "{first}");
}

/// Each mistake in a real device module is reported at the line where it was made.
#[test]
fn a_mistake_names_its_line() {
    let mistakes = [
        ("    let ix = to_int(cx) as u32;", "    let ix = cx as u32;"),
        (
            "    let ix = to_int(cx) as u32;",
            "    let ix = cx.floor() as u32;",
        ),
        (
            "    let ix = to_int(cx) as u32;",
            "    let ix = to_integer(cx) as u32;",
        ),
    ];
    for (sound, mistaken) in mistakes {
        let mut modules = device_modules();
        let perlin = modules.iter_mut().find(|m| m.path.ends_with("/perlin.rs"));
        let perlin = perlin.expect("there is gradient noise");
        let line = perlin
            .source
            .lines()
            .position(|l| l == sound)
            .expect("the line")
            + 1;
        perlin.source = perlin.source.replacen(sound, mistaken, 1);
        let place = format!("{}:{line}", perlin.path);
        let error = translate(&modules).expect_err(mistaken);
        assert_eq!(error.diagnostics[0].place.to_string(), place, "{error}");
    }
}

/// What naga alone notices is reported at a line of Rust, too: here a shift that is too
/// far, in device code, and a wrong type, in a host layer.
#[test]
fn what_naga_refuses_names_its_line() {
    let far = Module {
        path: "far.rs".to_owned(),
        source: "\n\npub fn far(x: u32) -> u32 {\n    let y = x;\n    y << 32\n}".to_owned(),
    };
    let translation = translate(&[far]).expect("it is of the subset");
    let error = check(&translation.source, Capabilities::empty()).expect_err("too far");
    assert_eq!(
        error.diagnostics[0].place.to_string(),
        "far.rs:5",
        "{error}"
    );

    let device = device(Vec::new());
    let mut all = device.stand_ins();
    all.append(&device.source);
    all.append(&Source::written(
        "host.wgsl",
        "// Host layer.\nfn host(x: f32) -> f32 {\n    return exp_(hash1(x));\n}",
    ));
    let error = check(&all, Capabilities::empty()).expect_err("a type is wrong");
    assert_eq!(
        error.diagnostics[0].place.to_string(),
        "host.wgsl:3",
        "{error}"
    );
}

/// An entry whose function has another face is refused at its line.
#[test]
fn a_wrong_entry_names_its_line() {
    let device = device(Vec::new());
    let table = module("matcha-shade/src/ops.rs");
    let mut families = support::modules("matcha-shade/src/ops");
    let noise = families.iter_mut().find(|m| m.path.ends_with("/noise.rs"));
    let noise = noise.expect("the family");
    let sound = "        eval: perlin::noise_4d,";
    let line = noise
        .source
        .lines()
        .position(|l| l == sound)
        .expect("the line")
        + 1;
    noise.source = noise
        .source
        .replacen(sound, "        eval: perlin::noise_3d,", 1);
    let place = format!("{}:{line}", noise.path);
    let error = matcha_wgsl::operations(&table, &families, &device).expect_err("it has a w");
    assert_eq!(error.diagnostics[0].place.to_string(), place, "{error}");
}

/// The cache names its intrinsics itself; they must be the prelude's.
#[test]
fn stand_ins_of_the_cache_are_the_prelude() {
    use matcha_cache::device::intrinsics as own;
    use matcha_shade::device::math as prelude;
    let numbers = [
        0.0,
        1.0,
        -1.5,
        3.25e-20,
        7.0e20,
        f32::MAX,
        f32::MIN_POSITIVE,
    ];
    let bits = |x: f32| x.to_bits();
    for x in numbers {
        assert_eq!(own::bits_of(x), prelude::bits_of(x));
        assert_eq!(
            bits(own::float_of(bits(x))),
            bits(prelude::float_of(bits(x)))
        );
        assert_eq!(bits(own::abs(x)), bits(prelude::abs(x)));
        assert_eq!(bits(own::sqrt(x.abs())), bits(prelude::sqrt(x.abs())));
        for y in numbers {
            assert_eq!(bits(own::min(x, y)), bits(prelude::min(x, y)));
            assert_eq!(bits(own::max(x, y)), bits(prelude::max(x, y)));
            assert_eq!(
                bits(own::select(x, y, x < y)),
                bits(prelude::select(x, y, x < y))
            );
            let (a, b) = (bits(x), bits(y));
            assert_eq!(own::wrapping_mul(a, b), prelude::wrapping_mul(a, b));
            assert_eq!(own::wrapping_add(a, b), prelude::wrapping_add(a, b));
        }
    }
}
