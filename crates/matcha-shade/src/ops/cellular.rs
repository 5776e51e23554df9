//! Cellular noise.

use crate::device::{voronoi_edge, voronoi_nearest, voronoi_smooth};

operations! {
    family cellular;

    /// Distance and cell of the nearest point in 1 dimension, Euclidean; the place is c + f. Cycles, Voronoi Texture.
    voronoi_f1_1d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1) -> F2 {
        cost: 1.7, error: 1e-4,
        loop: {
            count: voronoi_nearest::voronoi_f1_count_1d,
            init: voronoi_nearest::voronoi_f1_init,
            step: voronoi_nearest::voronoi_f1_step_1d,
            finish: voronoi_nearest::voronoi_f1_finish,
            state: 4,
        },
    }

    /// Distance and cell of the nearest point in 1 dimension, any metric. Cycles, Voronoi Texture.
    voronoi_nearest_1d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, exponent: F1, metric: U32) -> F2 {
        cost: 1.3, error: 1e-4,
        loop: {
            count: voronoi_nearest::voronoi_metric_count_1d,
            init: voronoi_nearest::voronoi_metric_init,
            step: voronoi_nearest::voronoi_metric_step_1d,
            finish: voronoi_nearest::voronoi_nearest_finish,
            state: 4,
        },
    }

    /// Distance and cell of the second nearest point in 1 dimension, any metric. Cycles, Voronoi Texture.
    voronoi_second_1d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, exponent: F1, metric: U32) -> F2 {
        cost: 1.4, error: 1e-4,
        loop: {
            count: voronoi_nearest::voronoi_metric_count_1d,
            init: voronoi_nearest::voronoi_metric_init,
            step: voronoi_nearest::voronoi_metric_step_1d,
            finish: voronoi_nearest::voronoi_second_finish,
            state: 4,
        },
    }

    /// Distance to the edge of the nearest point's region, and the cell beyond it, in 1 dimension. Cycles, Voronoi Texture.
    voronoi_edge_1d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, cell: F1) -> F2 {
        cost: 1.7, error: 1e-4,
        loop: {
            count: voronoi_edge::voronoi_edge_count_1d,
            init: voronoi_edge::voronoi_edge_init_1d,
            step: voronoi_edge::voronoi_edge_step_1d,
            finish: voronoi_edge::voronoi_edge_finish,
            state: 6,
        },
    }

    /// Half the nearest point's distance to its own nearest in 1 dimension. Cycles, Voronoi Texture.
    voronoi_radius_1d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, cell: F1) -> F1 {
        cost: 2.1, error: 1e-4,
        loop: {
            count: voronoi_edge::voronoi_edge_count_1d,
            init: voronoi_edge::voronoi_edge_init_1d,
            step: voronoi_edge::voronoi_radius_step_1d,
            finish: voronoi_edge::voronoi_radius_finish,
            state: 6,
        },
    }

    /// A cell's colour in 1 dimension. Cycles, Voronoi Texture.
    voronoi_color_1d(c: F3, cw: F1, cell: F1) -> Color {
        cost: 1.1, error: 0.0,
        eval: voronoi_nearest::voronoi_color_1d,
    }

    /// A cell's point in 1 dimension. Cycles, Voronoi Texture.
    voronoi_position_1d(c: F3, cw: F1, randomness: F1, cell: F1) -> F4 {
        cost: 0.9, error: 1e-5,
        eval: voronoi_nearest::voronoi_position_1d,
    }

    /// Smooth F1's distance in 1 dimension, Euclidean. Cycles, Voronoi Texture.
    voronoi_smooth_distance_1d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, smoothness: F1, exponent: F1, metric: U32) -> F1 {
        cost: 5.2, error: 1e-3,
        loop: {
            count: voronoi_smooth::voronoi_smooth_count_1d,
            init: voronoi_smooth::voronoi_smooth_distance_init,
            step: voronoi_smooth::voronoi_smooth_distance_step_1d,
            finish: voronoi_smooth::voronoi_smooth_distance_finish,
            state: 1,
        },
    }

    /// Smooth F1's distance in 1 dimension, any metric. Cycles, Voronoi Texture.
    voronoi_smooth_distance_metric_1d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, smoothness: F1, exponent: F1, metric: U32) -> F1 {
        cost: 5.4, error: 1e-3,
        loop: {
            count: voronoi_smooth::voronoi_smooth_count_1d,
            init: voronoi_smooth::voronoi_smooth_distance_init,
            step: voronoi_smooth::voronoi_smooth_distance_metric_step_1d,
            finish: voronoi_smooth::voronoi_smooth_distance_finish,
            state: 1,
        },
    }

    /// Smooth F1's color in 1 dimension, Euclidean. Cycles, Voronoi Texture.
    voronoi_smooth_color_1d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, smoothness: F1, exponent: F1, metric: U32) -> Color {
        cost: 8.0, error: 1e-3,
        loop: {
            count: voronoi_smooth::voronoi_smooth_count_1d,
            init: voronoi_smooth::voronoi_smooth_init,
            step: voronoi_smooth::voronoi_smooth_step_1d,
            finish: voronoi_smooth::voronoi_smooth_color,
            state: 8,
        },
    }

    /// Smooth F1's color in 1 dimension, any metric. Cycles, Voronoi Texture.
    voronoi_smooth_color_metric_1d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, smoothness: F1, exponent: F1, metric: U32) -> Color {
        cost: 7.9, error: 1e-3,
        loop: {
            count: voronoi_smooth::voronoi_smooth_count_1d,
            init: voronoi_smooth::voronoi_smooth_init,
            step: voronoi_smooth::voronoi_smooth_metric_step_1d,
            finish: voronoi_smooth::voronoi_smooth_color,
            state: 8,
        },
    }

    /// Smooth F1's position in 1 dimension, Euclidean. Cycles, Voronoi Texture.
    voronoi_smooth_position_1d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, smoothness: F1, exponent: F1, metric: U32) -> F4 {
        cost: 8.0, error: 1e-3,
        loop: {
            count: voronoi_smooth::voronoi_smooth_count_1d,
            init: voronoi_smooth::voronoi_smooth_init,
            step: voronoi_smooth::voronoi_smooth_step_1d,
            finish: voronoi_smooth::voronoi_smooth_position,
            state: 8,
        },
    }

    /// Smooth F1's position in 1 dimension, any metric. Cycles, Voronoi Texture.
    voronoi_smooth_position_metric_1d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, smoothness: F1, exponent: F1, metric: U32) -> F4 {
        cost: 7.9, error: 1e-3,
        loop: {
            count: voronoi_smooth::voronoi_smooth_count_1d,
            init: voronoi_smooth::voronoi_smooth_init,
            step: voronoi_smooth::voronoi_smooth_metric_step_1d,
            finish: voronoi_smooth::voronoi_smooth_position,
            state: 8,
        },
    }

    /// Distance and cell of the nearest point in 2 dimensions, Euclidean; the place is c + f. Cycles, Voronoi Texture.
    voronoi_f1_2d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1) -> F2 {
        cost: 7.4, error: 1e-4,
        loop: {
            count: voronoi_nearest::voronoi_f1_count_2d,
            init: voronoi_nearest::voronoi_f1_init,
            step: voronoi_nearest::voronoi_f1_step_2d,
            finish: voronoi_nearest::voronoi_f1_finish,
            state: 4,
        },
    }

    /// Distance and cell of the nearest point in 2 dimensions, any metric. Cycles, Voronoi Texture.
    voronoi_nearest_2d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, exponent: F1, metric: U32) -> F2 {
        cost: 53.5, error: 1e-4,
        loop: {
            count: voronoi_nearest::voronoi_metric_count_2d,
            init: voronoi_nearest::voronoi_metric_init,
            step: voronoi_nearest::voronoi_metric_step_2d,
            finish: voronoi_nearest::voronoi_nearest_finish,
            state: 4,
        },
    }

    /// Distance and cell of the second nearest point in 2 dimensions, any metric. Cycles, Voronoi Texture.
    voronoi_second_2d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, exponent: F1, metric: U32) -> F2 {
        cost: 53.5, error: 1e-4,
        loop: {
            count: voronoi_nearest::voronoi_metric_count_2d,
            init: voronoi_nearest::voronoi_metric_init,
            step: voronoi_nearest::voronoi_metric_step_2d,
            finish: voronoi_nearest::voronoi_second_finish,
            state: 4,
        },
    }

    /// Distance to the edge of the nearest point's region, and the cell beyond it, in 2 dimensions. Cycles, Voronoi Texture.
    voronoi_edge_2d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, cell: F1) -> F2 {
        cost: 10.4, error: 1e-4,
        loop: {
            count: voronoi_edge::voronoi_edge_count_2d,
            init: voronoi_edge::voronoi_edge_init_2d,
            step: voronoi_edge::voronoi_edge_step_2d,
            finish: voronoi_edge::voronoi_edge_finish,
            state: 6,
        },
    }

    /// Half the nearest point's distance to its own nearest in 2 dimensions. Cycles, Voronoi Texture.
    voronoi_radius_2d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, cell: F1) -> F1 {
        cost: 13.7, error: 1e-4,
        loop: {
            count: voronoi_edge::voronoi_edge_count_2d,
            init: voronoi_edge::voronoi_edge_init_2d,
            step: voronoi_edge::voronoi_radius_step_2d,
            finish: voronoi_edge::voronoi_radius_finish,
            state: 6,
        },
    }

    /// A cell's colour in 2 dimensions. Cycles, Voronoi Texture.
    voronoi_color_2d(c: F3, cw: F1, cell: F1) -> Color {
        cost: 1.4, error: 0.0,
        eval: voronoi_nearest::voronoi_color_2d,
    }

    /// A cell's point in 2 dimensions. Cycles, Voronoi Texture.
    voronoi_position_2d(c: F3, cw: F1, randomness: F1, cell: F1) -> F4 {
        cost: 1.3, error: 1e-5,
        eval: voronoi_nearest::voronoi_position_2d,
    }

    /// Smooth F1's distance in 2 dimensions, Euclidean. Cycles, Voronoi Texture.
    voronoi_smooth_distance_2d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, smoothness: F1, exponent: F1, metric: U32) -> F1 {
        cost: 27.9, error: 1e-3,
        loop: {
            count: voronoi_smooth::voronoi_smooth_count_2d,
            init: voronoi_smooth::voronoi_smooth_distance_init,
            step: voronoi_smooth::voronoi_smooth_distance_step_2d,
            finish: voronoi_smooth::voronoi_smooth_distance_finish,
            state: 1,
        },
    }

    /// Smooth F1's distance in 2 dimensions, any metric. Cycles, Voronoi Texture.
    voronoi_smooth_distance_metric_2d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, smoothness: F1, exponent: F1, metric: U32) -> F1 {
        cost: 154.0, error: 1e-3,
        loop: {
            count: voronoi_smooth::voronoi_smooth_count_2d,
            init: voronoi_smooth::voronoi_smooth_distance_init,
            step: voronoi_smooth::voronoi_smooth_distance_metric_step_2d,
            finish: voronoi_smooth::voronoi_smooth_distance_finish,
            state: 1,
        },
    }

    /// Smooth F1's color in 2 dimensions, Euclidean. Cycles, Voronoi Texture.
    voronoi_smooth_color_2d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, smoothness: F1, exponent: F1, metric: U32) -> Color {
        cost: 51.6, error: 1e-3,
        loop: {
            count: voronoi_smooth::voronoi_smooth_count_2d,
            init: voronoi_smooth::voronoi_smooth_init,
            step: voronoi_smooth::voronoi_smooth_step_2d,
            finish: voronoi_smooth::voronoi_smooth_color,
            state: 8,
        },
    }

    /// Smooth F1's color in 2 dimensions, any metric. Cycles, Voronoi Texture.
    voronoi_smooth_color_metric_2d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, smoothness: F1, exponent: F1, metric: U32) -> Color {
        cost: 173.0, error: 1e-3,
        loop: {
            count: voronoi_smooth::voronoi_smooth_count_2d,
            init: voronoi_smooth::voronoi_smooth_init,
            step: voronoi_smooth::voronoi_smooth_metric_step_2d,
            finish: voronoi_smooth::voronoi_smooth_color,
            state: 8,
        },
    }

    /// Smooth F1's position in 2 dimensions, Euclidean. Cycles, Voronoi Texture.
    voronoi_smooth_position_2d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, smoothness: F1, exponent: F1, metric: U32) -> F4 {
        cost: 53.2, error: 1e-3,
        loop: {
            count: voronoi_smooth::voronoi_smooth_count_2d,
            init: voronoi_smooth::voronoi_smooth_init,
            step: voronoi_smooth::voronoi_smooth_step_2d,
            finish: voronoi_smooth::voronoi_smooth_position,
            state: 8,
        },
    }

    /// Smooth F1's position in 2 dimensions, any metric. Cycles, Voronoi Texture.
    voronoi_smooth_position_metric_2d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, smoothness: F1, exponent: F1, metric: U32) -> F4 {
        cost: 175.0, error: 1e-3,
        loop: {
            count: voronoi_smooth::voronoi_smooth_count_2d,
            init: voronoi_smooth::voronoi_smooth_init,
            step: voronoi_smooth::voronoi_smooth_metric_step_2d,
            finish: voronoi_smooth::voronoi_smooth_position,
            state: 8,
        },
    }

    /// Distance and cell of the nearest point in 3 dimensions, Euclidean; the place is c + f. Cycles, Voronoi Texture.
    voronoi_f1_3d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1) -> F2 {
        cost: 39.4, error: 1e-4,
        loop: {
            count: voronoi_nearest::voronoi_f1_count_3d,
            init: voronoi_nearest::voronoi_f1_init,
            step: voronoi_nearest::voronoi_f1_step_3d,
            finish: voronoi_nearest::voronoi_f1_finish,
            state: 4,
        },
    }

    /// Distance and cell of the nearest point in 3 dimensions, any metric. Cycles, Voronoi Texture.
    voronoi_nearest_3d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, exponent: F1, metric: U32) -> F2 {
        cost: 208.0, error: 1e-4,
        loop: {
            count: voronoi_nearest::voronoi_metric_count_3d,
            init: voronoi_nearest::voronoi_metric_init,
            step: voronoi_nearest::voronoi_metric_step_3d,
            finish: voronoi_nearest::voronoi_nearest_finish,
            state: 4,
        },
    }

    /// Distance and cell of the second nearest point in 3 dimensions, any metric. Cycles, Voronoi Texture.
    voronoi_second_3d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, exponent: F1, metric: U32) -> F2 {
        cost: 210.0, error: 1e-4,
        loop: {
            count: voronoi_nearest::voronoi_metric_count_3d,
            init: voronoi_nearest::voronoi_metric_init,
            step: voronoi_nearest::voronoi_metric_step_3d,
            finish: voronoi_nearest::voronoi_second_finish,
            state: 4,
        },
    }

    /// Distance to the edge of the nearest point's region, and the cell beyond it, in 3 dimensions. Cycles, Voronoi Texture.
    voronoi_edge_3d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, cell: F1) -> F2 {
        cost: 48.2, error: 1e-4,
        loop: {
            count: voronoi_edge::voronoi_edge_count_3d,
            init: voronoi_edge::voronoi_edge_init_3d,
            step: voronoi_edge::voronoi_edge_step_3d,
            finish: voronoi_edge::voronoi_edge_finish,
            state: 6,
        },
    }

    /// Half the nearest point's distance to its own nearest in 3 dimensions. Cycles, Voronoi Texture.
    voronoi_radius_3d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, cell: F1) -> F1 {
        cost: 66.4, error: 1e-4,
        loop: {
            count: voronoi_edge::voronoi_edge_count_3d,
            init: voronoi_edge::voronoi_edge_init_3d,
            step: voronoi_edge::voronoi_radius_step_3d,
            finish: voronoi_edge::voronoi_radius_finish,
            state: 6,
        },
    }

    /// A cell's colour in 3 dimensions. Cycles, Voronoi Texture.
    voronoi_color_3d(c: F3, cw: F1, cell: F1) -> Color {
        cost: 2.1, error: 0.0,
        eval: voronoi_nearest::voronoi_color_3d,
    }

    /// A cell's point in 3 dimensions. Cycles, Voronoi Texture.
    voronoi_position_3d(c: F3, cw: F1, randomness: F1, cell: F1) -> F4 {
        cost: 2.3, error: 1e-5,
        eval: voronoi_nearest::voronoi_position_3d,
    }

    /// Smooth F1's distance in 3 dimensions, Euclidean. Cycles, Voronoi Texture.
    voronoi_smooth_distance_3d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, smoothness: F1, exponent: F1, metric: U32) -> F1 {
        cost: 210.0, error: 1e-3,
        loop: {
            count: voronoi_smooth::voronoi_smooth_count_3d,
            init: voronoi_smooth::voronoi_smooth_distance_init,
            step: voronoi_smooth::voronoi_smooth_distance_step_3d,
            finish: voronoi_smooth::voronoi_smooth_distance_finish,
            state: 1,
        },
    }

    /// Smooth F1's distance in 3 dimensions, any metric. Cycles, Voronoi Texture.
    voronoi_smooth_distance_metric_3d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, smoothness: F1, exponent: F1, metric: U32) -> F1 {
        cost: 948.0, error: 1e-3,
        loop: {
            count: voronoi_smooth::voronoi_smooth_count_3d,
            init: voronoi_smooth::voronoi_smooth_distance_init,
            step: voronoi_smooth::voronoi_smooth_distance_metric_step_3d,
            finish: voronoi_smooth::voronoi_smooth_distance_finish,
            state: 1,
        },
    }

    /// Smooth F1's color in 3 dimensions, Euclidean. Cycles, Voronoi Texture.
    voronoi_smooth_color_3d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, smoothness: F1, exponent: F1, metric: U32) -> Color {
        cost: 314.0, error: 1e-3,
        loop: {
            count: voronoi_smooth::voronoi_smooth_count_3d,
            init: voronoi_smooth::voronoi_smooth_init,
            step: voronoi_smooth::voronoi_smooth_step_3d,
            finish: voronoi_smooth::voronoi_smooth_color,
            state: 8,
        },
    }

    /// Smooth F1's color in 3 dimensions, any metric. Cycles, Voronoi Texture.
    voronoi_smooth_color_metric_3d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, smoothness: F1, exponent: F1, metric: U32) -> Color {
        cost: 996.0, error: 1e-3,
        loop: {
            count: voronoi_smooth::voronoi_smooth_count_3d,
            init: voronoi_smooth::voronoi_smooth_init,
            step: voronoi_smooth::voronoi_smooth_metric_step_3d,
            finish: voronoi_smooth::voronoi_smooth_color,
            state: 8,
        },
    }

    /// Smooth F1's position in 3 dimensions, Euclidean. Cycles, Voronoi Texture.
    voronoi_smooth_position_3d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, smoothness: F1, exponent: F1, metric: U32) -> F4 {
        cost: 314.0, error: 1e-3,
        loop: {
            count: voronoi_smooth::voronoi_smooth_count_3d,
            init: voronoi_smooth::voronoi_smooth_init,
            step: voronoi_smooth::voronoi_smooth_step_3d,
            finish: voronoi_smooth::voronoi_smooth_position,
            state: 8,
        },
    }

    /// Smooth F1's position in 3 dimensions, any metric. Cycles, Voronoi Texture.
    voronoi_smooth_position_metric_3d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, smoothness: F1, exponent: F1, metric: U32) -> F4 {
        cost: 993.0, error: 1e-3,
        loop: {
            count: voronoi_smooth::voronoi_smooth_count_3d,
            init: voronoi_smooth::voronoi_smooth_init,
            step: voronoi_smooth::voronoi_smooth_metric_step_3d,
            finish: voronoi_smooth::voronoi_smooth_position,
            state: 8,
        },
    }

    /// Distance and cell of the nearest point in 4 dimensions, Euclidean; the place is c + f. Cycles, Voronoi Texture.
    voronoi_f1_4d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1) -> F2 {
        cost: 199.0, error: 1e-4,
        loop: {
            count: voronoi_nearest::voronoi_f1_count_4d,
            init: voronoi_nearest::voronoi_f1_init,
            step: voronoi_nearest::voronoi_f1_step_4d,
            finish: voronoi_nearest::voronoi_f1_finish,
            state: 4,
        },
    }

    /// Distance and cell of the nearest point in 4 dimensions, any metric. Cycles, Voronoi Texture.
    voronoi_nearest_4d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, exponent: F1, metric: U32) -> F2 {
        cost: 786.0, error: 1e-4,
        loop: {
            count: voronoi_nearest::voronoi_metric_count_4d,
            init: voronoi_nearest::voronoi_metric_init,
            step: voronoi_nearest::voronoi_metric_step_4d,
            finish: voronoi_nearest::voronoi_nearest_finish,
            state: 4,
        },
    }

    /// Distance and cell of the second nearest point in 4 dimensions, any metric. Cycles, Voronoi Texture.
    voronoi_second_4d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, exponent: F1, metric: U32) -> F2 {
        cost: 785.0, error: 1e-4,
        loop: {
            count: voronoi_nearest::voronoi_metric_count_4d,
            init: voronoi_nearest::voronoi_metric_init,
            step: voronoi_nearest::voronoi_metric_step_4d,
            finish: voronoi_nearest::voronoi_second_finish,
            state: 4,
        },
    }

    /// Distance to the edge of the nearest point's region, and the cell beyond it, in 4 dimensions. Cycles, Voronoi Texture.
    voronoi_edge_4d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, cell: F1) -> F2 {
        cost: 227.0, error: 1e-4,
        loop: {
            count: voronoi_edge::voronoi_edge_count_4d,
            init: voronoi_edge::voronoi_edge_init_4d,
            step: voronoi_edge::voronoi_edge_step_4d,
            finish: voronoi_edge::voronoi_edge_finish,
            state: 6,
        },
    }

    /// Half the nearest point's distance to its own nearest in 4 dimensions. Cycles, Voronoi Texture.
    voronoi_radius_4d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, cell: F1) -> F1 {
        cost: 276.0, error: 1e-4,
        loop: {
            count: voronoi_edge::voronoi_edge_count_4d,
            init: voronoi_edge::voronoi_edge_init_4d,
            step: voronoi_edge::voronoi_radius_step_4d,
            finish: voronoi_edge::voronoi_radius_finish,
            state: 6,
        },
    }

    /// A cell's colour in 4 dimensions. Cycles, Voronoi Texture.
    voronoi_color_4d(c: F3, cw: F1, cell: F1) -> Color {
        cost: 2.5, error: 0.0,
        eval: voronoi_nearest::voronoi_color_4d,
    }

    /// A cell's point in 4 dimensions. Cycles, Voronoi Texture.
    voronoi_position_4d(c: F3, cw: F1, randomness: F1, cell: F1) -> F4 {
        cost: 3.0, error: 1e-5,
        eval: voronoi_nearest::voronoi_position_4d,
    }

    /// Smooth F1's distance in 4 dimensions, Euclidean. Cycles, Voronoi Texture.
    voronoi_smooth_distance_4d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, smoothness: F1, exponent: F1, metric: U32) -> F1 {
        cost: 1635.0, error: 1e-3,
        loop: {
            count: voronoi_smooth::voronoi_smooth_count_4d,
            init: voronoi_smooth::voronoi_smooth_distance_init,
            step: voronoi_smooth::voronoi_smooth_distance_step_4d,
            finish: voronoi_smooth::voronoi_smooth_distance_finish,
            state: 1,
        },
    }

    /// Smooth F1's distance in 4 dimensions, any metric. Cycles, Voronoi Texture.
    voronoi_smooth_distance_metric_4d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, smoothness: F1, exponent: F1, metric: U32) -> F1 {
        cost: 10092.0, error: 1e-3,
        loop: {
            count: voronoi_smooth::voronoi_smooth_count_4d,
            init: voronoi_smooth::voronoi_smooth_distance_init,
            step: voronoi_smooth::voronoi_smooth_distance_metric_step_4d,
            finish: voronoi_smooth::voronoi_smooth_distance_finish,
            state: 1,
        },
    }

    /// Smooth F1's color in 4 dimensions, Euclidean. Cycles, Voronoi Texture.
    voronoi_smooth_color_4d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, smoothness: F1, exponent: F1, metric: U32) -> Color {
        cost: 2756.0, error: 1e-3,
        loop: {
            count: voronoi_smooth::voronoi_smooth_count_4d,
            init: voronoi_smooth::voronoi_smooth_init,
            step: voronoi_smooth::voronoi_smooth_step_4d,
            finish: voronoi_smooth::voronoi_smooth_color,
            state: 8,
        },
    }

    /// Smooth F1's color in 4 dimensions, any metric. Cycles, Voronoi Texture.
    voronoi_smooth_color_metric_4d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, smoothness: F1, exponent: F1, metric: U32) -> Color {
        cost: 14914.0, error: 1e-3,
        loop: {
            count: voronoi_smooth::voronoi_smooth_count_4d,
            init: voronoi_smooth::voronoi_smooth_init,
            step: voronoi_smooth::voronoi_smooth_metric_step_4d,
            finish: voronoi_smooth::voronoi_smooth_color,
            state: 8,
        },
    }

    /// Smooth F1's position in 4 dimensions, Euclidean. Cycles, Voronoi Texture.
    voronoi_smooth_position_4d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, smoothness: F1, exponent: F1, metric: U32) -> F4 {
        cost: 2620.0, error: 1e-3,
        loop: {
            count: voronoi_smooth::voronoi_smooth_count_4d,
            init: voronoi_smooth::voronoi_smooth_init,
            step: voronoi_smooth::voronoi_smooth_step_4d,
            finish: voronoi_smooth::voronoi_smooth_position,
            state: 8,
        },
    }

    /// Smooth F1's position in 4 dimensions, any metric. Cycles, Voronoi Texture.
    voronoi_smooth_position_metric_4d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, smoothness: F1, exponent: F1, metric: U32) -> F4 {
        cost: 14967.0, error: 1e-3,
        loop: {
            count: voronoi_smooth::voronoi_smooth_count_4d,
            init: voronoi_smooth::voronoi_smooth_init,
            step: voronoi_smooth::voronoi_smooth_metric_step_4d,
            finish: voronoi_smooth::voronoi_smooth_position,
            state: 8,
        },
    }

    /// Distance to a cell's point in 1 dimension, Euclidean. Cycles, Voronoi Texture.
    voronoi_distance_1d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, cell: F1) -> F1 {
        cost: 1.0, error: 1e-4,
        eval: voronoi_nearest::voronoi_distance_1d,
    }

    /// Distance to a cell's point in 2 dimensions, Euclidean. Cycles, Voronoi Texture.
    voronoi_distance_2d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, cell: F1) -> F1 {
        cost: 1.5, error: 1e-4,
        eval: voronoi_nearest::voronoi_distance_2d,
    }

    /// Distance to the border between two cells' points in 2 dimensions. Cycles, Voronoi Texture.
    voronoi_border_2d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, cell: F1, beyond: F1) -> F1 {
        cost: 2.5, error: 1e-4,
        eval: voronoi_edge::voronoi_border_2d,
    }

    /// Distance to a cell's point in 3 dimensions, Euclidean. Cycles, Voronoi Texture.
    voronoi_distance_3d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, cell: F1) -> F1 {
        cost: 2.0, error: 1e-4,
        eval: voronoi_nearest::voronoi_distance_3d,
    }

    /// Distance to the border between two cells' points in 3 dimensions. Cycles, Voronoi Texture.
    voronoi_border_3d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, cell: F1, beyond: F1) -> F1 {
        cost: 4.0, error: 1e-4,
        eval: voronoi_edge::voronoi_border_3d,
    }

    /// Distance to a cell's point in 4 dimensions, Euclidean. Cycles, Voronoi Texture.
    voronoi_distance_4d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, cell: F1) -> F1 {
        cost: 3.0, error: 1e-4,
        eval: voronoi_nearest::voronoi_distance_4d,
    }

    /// Distance to the border between two cells' points in 4 dimensions. Cycles, Voronoi Texture.
    voronoi_border_4d(c: F3, cw: F1, f: F3, fw: F1, randomness: F1, cell: F1, beyond: F1) -> F1 {
        cost: 6.0, error: 1e-4,
        eval: voronoi_edge::voronoi_border_4d,
    }
}
