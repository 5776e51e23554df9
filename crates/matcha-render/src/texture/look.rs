//! Settings of look-ups as device code knows them.

use crate::device::texture_filter::*;
use crate::device::texture_view::*;
use matcha_shade::graph::{AlphaHandling, Interpolation};
use matcha_shade::source::Extension;

/// The code of a filter.
#[inline]
pub(crate) fn filter_code(interpolation: Interpolation) -> u32 {
    match interpolation {
        Interpolation::Closest => TEXTURE_CLOSEST,
        Interpolation::Linear => TEXTURE_LINEAR,
        Interpolation::Cubic | Interpolation::Smart => TEXTURE_CUBIC,
    }
}

/// The code of what is outside of an image.
#[inline]
pub(crate) fn wrap_code(extension: Extension) -> u32 {
    match extension {
        Extension::Repeat => TEXTURE_REPEAT,
        Extension::Extend => TEXTURE_EXTEND,
        Extension::Clip => TEXTURE_CLIP,
        Extension::Mirror => TEXTURE_MIRROR,
    }
}

/// The code of a treatment of alpha.
pub(crate) fn alpha_code(alpha: AlphaHandling) -> u32 {
    match alpha {
        AlphaHandling::Associated => TEXTURE_ALPHA_ASSOCIATED,
        AlphaHandling::Unassociated => TEXTURE_ALPHA_UNASSOCIATED,
        AlphaHandling::Ignored => TEXTURE_ALPHA_IGNORED,
    }
}
