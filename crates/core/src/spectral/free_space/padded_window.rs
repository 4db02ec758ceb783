//! A window on a grid at least twice as wide that is padded with zeros: the transforms of its kernels there, and its periodic repetition.
//!
//! H of the symmetric kernel, G of the odd one of a shear traction, and Ĉ of the window repeated at the same spacings.

use super::kernel::{OfWavenumber, Window};
use super::quadrant::{Parity, transformed};
use crate::lattice::{Cell, Grid};
use crate::numeric::fourier::fast_points;
use crate::numeric::lanes::Real;
use crate::spectral::convolution::{Convolution, ShearMultiplier, VectorMultiplier};
use crate::spectral::multiplier::{Multiplier, SkewPart};
use crate::spectral::transforms::Transforms;
use ndarray::Array2;

/// Memory that an operator in free space on a window of `points` keeps, bytes per sample: the transforms of the kernel and, `coupled`, of
/// the odd one, 16 each where no padding beyond twice the window is needed, and the periodic compliance, 4. The [`Workspace`] has 16
/// further ones. While a kernel is made, three tables of 8 live besides.
///
/// [`Workspace`]: crate::spectral::Workspace
pub(in crate::spectral) fn bytes_per_sample(points: [usize; 2], coupled: bool) -> f64 {
    let components = |[n1, n2]: [usize; 2]| (n1 * (n2 / 2 + 1).next_multiple_of(f32::WIDTH)) as f64;
    let tables = components(padded(points)) * f64::from(1 + u8::from(coupled)) + components(points);
    8.0 * tables / (points[0] * points[1]) as f64
}

/// Memory while the kernel of a window is made besides its tables, bytes; much where the samples are oblong.
pub(in crate::spectral) fn bytes_while_made(window: Cell, points: [usize; 2]) -> usize {
    let [a1, a2] = window.vectors();
    let spacings = [a1[0] / points[0] as f64, a2[1] / points[1] as f64];
    Window { spacings, points }.bytes_while_made()
}

/// Samples of the transforms for a window: at least 2Nᵢ − 1, even, and with small prime factors.
pub(in crate::spectral) fn padded(points: [usize; 2]) -> [usize; 2] {
    points.map(|n| 2 * fast_points(n))
}

/// H, the transform of the kernel.
pub(super) fn multiplier(convolution: &Convolution<f64>, window: Window, c: OfWavenumber<'_>) -> Multiplier {
    let values = transformed(&window.kernel(c), padded(window.points), [Parity::Even; 2]);
    convolution.multiplier(true, |[k1, k2], to| {
        to.iter_mut().zip(k2..).for_each(|(to, k2)| *to = values[[k2, k1]]);
    })
}

/// G, the transform of the odd kernel of a traction with the components `along` the axes of the grid.
pub(super) fn skew_part(
    convolution: &Convolution<f64>,
    window: Window,
    along: [f64; 2],
    b: OfWavenumber<'_>,
) -> SkewPart {
    let padded = padded(window.points);
    let values: [Option<Array2<f64>>; 2] = [0, 1].map(|axis| {
        let mut parities = [Parity::Even; 2];
        parities[axis] = Parity::Odd;
        (along[axis] != 0.0).then(|| along[axis] * transformed(&window.coupling_kernel(b, axis), padded, parities))
    });
    convolution.skew_part(|[k1, k2], to| {
        // Odd along the first axis, and even.
        let (k1, sign) = if 2 * k1 <= padded[0] { (k1, 1.0) } else { (padded[0] - k1, -1.0) };
        for (to, k2) in to.iter_mut().zip(k2..) {
            let [first, second] =
                values.each_ref().map(|values| values.as_ref().map_or(0.0, |values| values[[k2, k1]]));
            *to = sign * first + second;
        }
    })
}

/// Â, the transform of the kernels of shear tractions of c(k) = k·½(L + S) and a(k) = k·½(L − S) on a window with the unit vectors `axes`.
pub(in crate::spectral) fn shear_multiplier(
    convolution: &Convolution<f64>,
    window: Window,
    axes: [[f64; 2]; 2],
    [c, a]: [OfWavenumber<'_>; 2],
) -> ShearMultiplier {
    let padded = padded(window.points);
    let uniform = transformed(&window.kernel(c), padded, [Parity::Even; 2]);
    let [cosine, sine] = window.shear_kernels(a);
    let cosine = transformed(&cosine, padded, [Parity::Even; 2]);
    // The transform of a kernel that is odd along both axes is minus its sum of products of sines.
    let sine = transformed(&sine, padded, [Parity::Odd; 2]);
    let [[x1, y1], [x2, y2]] = axes;
    ShearMultiplier::new(convolution, |[k1, k2]| {
        let (k1, sign) = if 2 * k1 <= padded[0] { (k1, -1.0) } else { (padded[0] - k1, 1.0) };
        let place = [k2, k1];
        let (along, across) = (uniform[place] + cosine[place], uniform[place] - cosine[place]);
        let mixed = sign * sine[place];
        [
            x1 * x1 * along + x2 * x2 * across + 2.0 * x1 * x2 * mixed,
            y1 * y1 * along + y2 * y2 * across + 2.0 * y1 * y2 * mixed,
            x1 * y1 * along + x2 * y2 * across + (x1 * y2 + x2 * y1) * mixed,
        ]
    })
}

/// G of both components of a shear traction on a window with the unit vectors `axes`.
pub(in crate::spectral) fn coupling_multiplier(
    convolution: &Convolution<f64>,
    window: Window,
    axes: [[f64; 2]; 2],
    b: OfWavenumber<'_>,
) -> VectorMultiplier {
    let padded = padded(window.points);
    let values = [0, 1].map(|axis| {
        let mut parities = [Parity::Even; 2];
        parities[axis] = Parity::Odd;
        transformed(&window.coupling_kernel(b, axis), padded, parities)
    });
    VectorMultiplier::new(convolution, |[k1, k2]| {
        let (k1, sign) = if 2 * k1 <= padded[0] { (k1, 1.0) } else { (padded[0] - k1, -1.0) };
        let [along, across] = [sign * values[0][[k2, k1]], values[1][[k2, k1]]];
        [0, 1].map(|component| along * axes[0][component] + across * axes[1][component])
    })
}

/// The window repeated periodically: its transforms and Ĉ, the mean taken for a component of the least wavenumber.
pub(super) fn repeated(grid: &Grid, c: OfWavenumber<'_>) -> (Transforms, Multiplier) {
    let transforms = Transforms::new(grid.points());
    let compliance = transforms.double.multiplier(true, |first, values| {
        grid.wavenumbers(first, values);
        if first == [0, 0] {
            values[0] = grid.least_wavenumber();
        }
        values.iter_mut().for_each(|k| *k = c(*k) / *k);
    });
    (transforms, compliance)
}
