//! The balance of the forces on a drop along its wall, with each force measured independently.
//!
//! d(P)/dt = body force less buoyancy + friction of the wall + drag of the other fluid − σ (cos θ_R − cos θ_A). The wall friction includes that under the
//! wedges next to the contact lines, so the balance is closed by the angles at the wall, which the wetting model prescribes. With the apparent angles of
//! moving lines the friction in the wedge would count twice, since it is what bends the interface there.

use super::series::{last, last_mean};
use meniscus_core::solver::{Measure, Series, measure};
use meniscus_sph::measures::Subject;

/// Last fraction of the time over which the balance is averaged. It holds at all times, also during acceleration, and a drop of low viscosity oscillates: a
/// long average is best.
const BALANCED: f64 = 0.75;

/// Error of the momentum balance over the tension that causes a warning: the drag is known no more accurately.
const LARGEST_ERROR: f64 = 0.01;

/// Mean forces along the wall in N/m over the last three quarters of the time.
struct Balance {
    /// Tension times the difference of the cosines of the apparent angles.
    retention: f64,
    /// The same for the angles at the wall.
    wall_retention: f64,
    /// Pressure and viscous force of the other fluid.
    stream: f64,
    /// The sum of all forces but the retention, minus the rate of change of the momentum.
    net_drag: f64,
    tension: f64,
}

impl Balance {
    fn of(s: &Subject) -> Self {
        let (tension, series) = (s.flow.config.method.tension, s.series);
        // Mean of cosines: for a line in stick-slip it differs from the cosine of the mean angle.
        let cosine = |column: &str| average(series, column, |angle| angle.to_radians().cos());
        let pull = |advancing: &str, receding: &str| tension * (cosine(receding) - cosine(advancing));
        let force = |column: &str| average(series, column, |force| force);
        let stream = force("stream_pressure_N_per_m") + force("stream_friction_N_per_m");
        let others = force("drive_N_per_m") + force("wall_friction_N_per_m");
        Self {
            retention: pull("advancing_angle_deg", "receding_angle_deg"),
            wall_retention: pull("advancing_wall_angle_deg", "receding_wall_angle_deg"),
            stream,
            net_drag: others + stream - rise(series, "drop_momentum_kg_per_m_s"),
            tension,
        }
    }

    /// Residual of the balance over the tension.
    fn error(&self) -> f64 {
        (self.net_drag - self.wall_retention) / self.tension
    }
}

/// Warns if the forces on the drop do not balance.
pub(crate) fn warnings(s: &Subject) -> Vec<String> {
    let error = Balance::of(s).error();
    let warning = (error.abs() > LARGEST_ERROR).then(|| {
        format!(
            "the forces on the drop along its wall miss the change of its momentum by {error:.3} of the tension: drag and retention are \
             known no better (momentum-balance-error)"
        )
    });
    warning.into_iter().collect()
}

/// The angles at the wall and the force balance along it.
pub(crate) fn measures(s: &Subject) -> Vec<Measure> {
    let (tension, series) = (s.flow.config.method.tension, s.series);
    let balance = Balance::of(s);
    let (apparent, at_wall, drag) = (balance.retention, balance.wall_retention, balance.net_drag);
    let model = "angle at which the wetting model asks the interface to meet the wall; mean over the last quarter of the records";
    let angles = ["advancing_wall_angle_deg", "receding_wall_angle_deg"].map(|column| last_mean(series, column));
    let static_angle = s.flow.config.method.wetting.map_or(f64::NAN, |model| model.static_angle());
    let range = s.flow.config.method.wetting.map(|model| model.hysteresis_range());
    let [receding, advancing] = range.unwrap_or([f64::NAN; 2]);
    let largest = Some(tension * (receding.cos() - advancing.cos())).filter(|largest| *largest > 0.0);
    let retention = "tension times (cosine of the receding less that of the advancing angle), mean over the last three quarters of the time";
    vec![
        measure("advancing-wall-angle-deg", angles[0].0, "deg").by(model).with_uncertainty(angles[0].1),
        measure("receding-wall-angle-deg", angles[1].0, "deg").by(model).with_uncertainty(angles[1].1),
        measure("adhesion-tension-N-per-m", tension * static_angle.cos(), "N/m")
            .by("tension times the cosine of the static angle: that of the dry less that of the wetted wall"),
        measure("retention-N-per-m", apparent, "N/m").by(retention),
        measure("wall-retention-N-per-m", at_wall, "N/m").by("the same with the angles at the wall"),
        measure("stream-drag-N-per-m", balance.stream, "N/m")
            .by("pressure of the other fluid on the interface less buoyancy, and its friction, ahead; mean over the \
                 last three quarters of the time"),
        measure("net-drag-N-per-m", drag, "N/m")
            .by("body force less buoyancy plus friction of the wall plus drag of the stream less the change of the \
                 momentum of the drop, along the wall, over the last three quarters of the time"),
        measure("drag-over-retention", drag / apparent, "").by("net drag over the retention by the apparent angles"),
        measure("drag-over-wall-retention", drag / at_wall, "")
            .by("net drag over the retention by the angles at the wall"),
        measure("drag-over-largest-retention", largest.map_or(f64::NAN, |largest| drag / largest), "").by(match largest {
            Some(_) => "net drag over the tension times (cosine of the receding less that of the advancing angle of the hysteresis)",
            None => "the wall has a single static angle, which holds nothing",
        }),
        measure("momentum-balance-error", balance.error(), "")
            .by("net drag less the retention by the angles at the wall, over the tension"),
    ]
}

/// The time average of a function of a column over the last three quarters of the time, by the trapezoidal rule.
fn average(series: &Series, column: &str, f: impl Fn(f64) -> f64) -> f64 {
    let points = last(series, column, BALANCED);
    let (mut sum, mut time) = (0.0, 0.0);
    for pair in points.windows(2) {
        let dt = pair[1].0 - pair[0].0;
        sum += 0.5 * dt * (f(pair[0].1) + f(pair[1].1));
        time += dt;
    }
    sum / time
}

/// Mean rate of change of a column over the last three quarters of the time, from its end values: the counterpart of the mean force.
fn rise(series: &Series, column: &str) -> f64 {
    match last(series, column, BALANCED)[..] {
        [first, .., last] => (last.1 - first.1) / (last.0 - first.0),
        _ => f64::NAN,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_of_a_force_is_the_gain_of_momentum_however_it_swings() {
        // A force 1 + 20 cos(20 t), sampled twenty times per period, and its momentum.
        let rows = (0..=200).map(|i| {
            let t = 0.0157 * f64::from(i);
            vec![t, 1.0 + 20.0 * (20.0 * t).cos(), t + (20.0 * t).sin()]
        });
        let columns = ["time_s", "force", "momentum"].map(str::to_owned).to_vec();
        let series = Series { columns, rows: rows.collect() };
        let (force, gain) = (average(&series, "force", |f| f), rise(&series, "momentum"));
        // Accuracy of the trapezoidal rule with twenty points per period.
        assert!((force - gain).abs() < 0.02, "{force} {gain}");
    }
}
