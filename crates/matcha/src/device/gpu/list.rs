//! Adapters in words.

use matcha_gpu::adapter::{AdapterReport, Kind};

/// All adapters for people; `automatic` is the number of the one that `auto` takes.
pub(super) fn text(reports: &[AdapterReport], automatic: Option<usize>) -> String {
    if reports.is_empty() {
        return "there is no graphics adapter with Vulkan, Metal or DX12; --device auto takes the CPU\n"
            .to_owned();
    }
    let mut text: String = reports.iter().map(adapter).collect();
    text += &match automatic {
        Some(number) => format!("--device auto takes gpu:{number}\n"),
        None => "--device auto takes the CPU: no GPU can render\n".to_owned(),
    };
    text
}

fn adapter(report: &AdapterReport) -> String {
    let mut text = format!(
        "gpu:{} {} ({}, {})\n    driver: {}\n    limits: bindings of {} MiB, buffers of {} MiB, {} storage buffers, \
         workgroups of {}, subgroups of {}\n",
        report.number,
        report.name,
        kind(report.kind),
        report.backend,
        report.driver,
        report.binding_bytes >> 20,
        report.buffer_bytes >> 20,
        report.storage_buffers,
        report.invocations,
        range(report.subgroup)
    );
    if report.ray_queries {
        text += "    has ray queries: --ray-queries traces with them (experimental)\n";
    }
    for (word, list) in [("lacks", &report.lacks), ("does without", &report.misses)] {
        for what in list {
            text += &format!("    {word}: {what}\n");
        }
    }
    text
}

fn kind(kind: Kind) -> &'static str {
    match kind {
        Kind::Discrete => "a GPU",
        Kind::Integrated => "a GPU in the processor",
        Kind::Virtual => "a GPU of a virtual machine",
        Kind::Unknown => "of a kind that the driver does not tell",
        Kind::Software => "a driver that computes on the processor",
    }
}

fn range([fewest, most]: [u32; 2]) -> String {
    if fewest == most {
        most.to_string()
    } else {
        format!("{fewest} to {most}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_said_in_a_sentence() {
        assert!(text(&[], None).starts_with("there is no graphics adapter"));
    }

    #[test]
    fn subgroups_are_a_number_or_a_range() {
        assert_eq!(range([8, 8]), "8");
        assert_eq!(range([32, 64]), "32 to 64");
    }
}
