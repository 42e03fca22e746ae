use crate::mechanics::tree::held::{HeldSystem, Hold};

/// Stops of dry friction within one kick, per degree of freedom, before what is left of it is taken at once.
const STOPS_PER_JOINT: usize = 4;

/// Speed (rad/s or m/s) that a bound takes away above which the kick is an impact.
const IMPACT_SPEED: f64 = 1e-6;

/// What acts during one kick of the leapfrog.
#[derive(Debug, Clone, Copy)]
pub(super) struct Kick<'a> {
    /// Lower triangle of the mass matrix with the implicit part of damping, row by row.
    pub matrix: &'a [f64],
    /// Generalised force without dry friction and stops (N m or N).
    pub force: &'a [f64],
    /// Level of dry friction (N m or N).
    pub dry: &'a [f64],
    /// Least and largest velocity after the kick (rad/s or m/s): stops.
    pub bounds: &'a [(f64, f64)],
    /// Its length (s).
    pub span_s: f64,
}

/// Velocities through a kick, with dry friction and stops.
///
/// Between the instants at which a joint comes to rest, breaks loose or turns round, accelerations are constant,
///
/// ```text
/// A dv/dt = force + friction,    friction in -dry sign(v),  -dry sign(dv/dt) where v = 0
/// ```
///
/// so that the kick is gone through from one such instant to the next and its velocity is exact. A kick that would carry
/// a joint past its stop is taken at once, as Moreau (1988) and Stewart & Trinkle (1996) do:
///
/// ```text
/// A (v' - v) = span (force + friction) + impulse,    least <= v' <= most
/// ```
#[derive(Debug, Clone)]
pub(super) struct Kicker {
    system: HeldSystem,
    holds: Vec<Hold>,
    right: Vec<f64>,
    before: Vec<f64>,
    /// Velocities (rad/s or m/s).
    pub velocity: Vec<f64>,
    /// Accelerations at the end of the kick (rad/s² or m/s²).
    pub acceleration: Vec<f64>,
    /// Mean force of dry friction and stops over the kick (N m or N).
    pub constraint: Vec<f64>,
}

impl Kicker {
    /// Rest, for `count` degrees of freedom.
    pub fn new(count: usize) -> Self {
        let zeros = vec![0.0; count];
        Self {
            system: HeldSystem::new(count),
            holds: vec![Hold::NONE; count],
            right: zeros.clone(),
            before: zeros.clone(),
            velocity: zeros.clone(),
            acceleration: zeros.clone(),
            constraint: zeros,
        }
    }

    /// Takes the velocities through a kick.
    pub fn kick(&mut self, kick: &Kick<'_>) {
        self.before.copy_from_slice(&self.velocity);
        self.constraint.fill(0.0);
        self.slide(kick);
        let passes = |(v, (least, most)): (&f64, &(f64, f64))| v < least || v > most;
        if self.velocity.iter().zip(kick.bounds).any(passes) {
            self.velocity.copy_from_slice(&self.before);
            self.strike(kick);
        }
    }

    /// From one change of dry friction to the next.
    fn slide(&mut self, kick: &Kick<'_>) {
        let mut left_s = kick.span_s;
        for _ in 0..=STOPS_PER_JOINT * self.velocity.len() {
            self.accelerate(kick);
            let (at_s, who) = self.next_stop(kick, left_s);
            let share = at_s / kick.span_s;
            for i in 0..self.velocity.len() {
                let moving = self.velocity[i].abs() > 0.0;
                let friction = if moving && kick.dry[i] > 0.0 {
                    -kick.dry[i].copysign(self.velocity[i])
                } else {
                    self.system.held[i]
                };
                self.constraint[i] += share * friction;
            }
            for (v, a) in self.velocity.iter_mut().zip(&self.system.rate) {
                *v += at_s * a;
            }
            left_s -= at_s;
            let Some(who) = who else { break };
            self.velocity[who] = 0.0;
        }
        for (v, a) in self.velocity.iter_mut().zip(&self.system.rate) {
            *v += left_s * a;
        }
        self.acceleration.copy_from_slice(&self.system.rate);
    }

    /// Accelerations: friction of what moves is known, what rests holds or breaks loose.
    fn accelerate(&mut self, kick: &Kick<'_>) {
        for i in 0..self.velocity.len() {
            let (v, dry) = (self.velocity[i], kick.dry[i]);
            let slides = dry > 0.0 && v.abs() > 0.0;
            self.right[i] = if slides { kick.force[i] - dry.copysign(v) } else { kick.force[i] };
            self.holds[i] = if slides { Hold::NONE } else { Hold::dry(dry) };
        }
        self.system.solve(kick.matrix, &self.right, &self.holds);
    }

    /// Time (s) until the first joint under friction comes to rest, and which; all the time that is left if none does.
    fn next_stop(&self, kick: &Kick<'_>, left_s: f64) -> (f64, Option<usize>) {
        let mut first = (left_s, None);
        for (i, (&v, &a)) in self.velocity.iter().zip(&self.system.rate).enumerate() {
            if kick.dry[i] > 0.0 && v * a < 0.0 && -v / a < first.0 {
                first = (-v / a, Some(i));
            }
        }
        first
    }

    /// The whole kick at once, within the bounds.
    fn strike(&mut self, kick: &Kick<'_>) {
        let (count, span) = (self.velocity.len(), kick.span_s);
        for i in 0..count {
            let carried: f64 = (0..count)
                .map(|j| kick.matrix[i.max(j) * count + i.min(j)] * self.velocity[j])
                .sum();
            self.right[i] = carried + span * kick.force[i];
            let (least, most) = kick.bounds[i];
            self.holds[i] = Hold { dry: span * kick.dry[i], least, most };
        }
        self.system.solve(kick.matrix, &self.right, &self.holds);
        let struck = (0..count).any(|i| {
            let taken = self.velocity[i] - self.system.rate[i];
            self.system.is_bounded(i) && taken.abs() > IMPACT_SPEED
        });
        for i in 0..count {
            let after = self.system.rate[i];
            let smooth = !struck && !self.system.is_bounded(i);
            self.acceleration[i] = if smooth { (after - self.velocity[i]) / span } else { 0.0 };
            self.constraint[i] = self.system.held[i] / span;
            self.velocity[i] = after;
        }
    }
}
