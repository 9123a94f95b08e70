//! The tasks of a command with their probabilities, and how those of a group are weighed among themselves.

use goodbot::probability::exp;

/// The probability, in equal parts, that is mixed into the role model's posterior.
const FLOOR: f32 = 0.03;
/// The role model's part in a pool. With 0.5, more pieces are mistaken; from 0.1 to 0.3, the log loss of the houses differs by 0.02.
const POOLED: f32 = 0.2;

/// A group of tasks that are weighed among themselves, by their kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Group {
    /// The kind was meant before.
    #[default]
    Met,
    /// The kind was never meant.
    Unmet,
    /// No session could mean the kind.
    Impossible,
}

/// A task with its probabilities.
#[derive(Clone, Copy, Debug, Default)]
pub struct Weighed {
    pub group: Group,
    /// The role model's posterior.
    pub understood: f32,
    /// The logarithm of the role model's posterior within its group, with the floor.
    pub logarithm: f32,
    /// The sum of U over its parts.
    pub parts: f32,
    /// What the network says, where the task was meant in this scene and the scene was taught often.
    pub itself: Option<f32>,
    /// The layer's posterior among the tasks of its group, and among all, without the network.
    pub within: f32,
    pub trusted: f32,
    /// The layer's posterior.
    pub believed: f32,
}

/// Weighs the tasks within each group. Nothing was learned for or against a kind that was never meant, so each group keeps the probability
/// that the role model gives it.
pub fn weigh(tasks: &mut [Weighed], trust: f32) {
    for group in [Group::Met, Group::Unmet, Group::Impossible] {
        let of_group = |task: &&mut Weighed| task.group == group;
        let (mut count, mut mass) = (0_usize, 0.0_f32);
        for task in tasks.iter().filter(|task| task.group == group) {
            (count, mass) = (count.saturating_add(1), mass + task.understood);
        }
        let share = |understood: f32| if mass > 0.0 { understood / mass } else { 0.0 };
        let mut best = f32::MIN;
        for task in tasks.iter_mut().filter(of_group) {
            task.logarithm = libm::logf(share(task.understood) + FLOOR / count.max(1) as f32);
            task.within = trust * task.logarithm + task.parts;
            best = best.max(task.within);
        }
        let mut sum = 0.0;
        for task in tasks.iter_mut().filter(of_group) {
            task.within = exp(task.within - best);
            sum += task.within;
        }
        for task in tasks.iter_mut().filter(of_group) {
            task.within /= sum;
            (task.trusted, task.believed) = (mass * task.within, mass * task.within);
        }
    }
    // Nothing was learned for or against a task that was never meant in this scene: the others share what they have together. The network
    // counts as much as the rest of the layer.
    let logarithm = |task: &Weighed| {
        let itself = task.itself?;
        Some(0.5 * (itself + libm::logf(task.believed.max(f32::MIN_POSITIVE))))
    };
    let best = tasks.iter().filter_map(logarithm).fold(f32::MIN, f32::max);
    let (mut whole, mut sum) = (0.0, 0.0);
    for task in tasks.iter_mut() {
        let Some(logarithm) = logarithm(task) else { continue };
        whole += task.believed;
        task.believed = exp(logarithm - best);
        sum += task.believed;
    }
    tasks.iter_mut().filter(|task| task.itself.is_some()).for_each(|task| task.believed *= whole / sum);
}

/// Mixes the role model's posterior into the layer's: a linear pool.
pub fn pool(tasks: &mut [Weighed]) {
    tasks.iter_mut().for_each(|task| task.believed += POOLED * (task.understood - task.believed));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pool_leaves_some_probability_to_what_only_the_role_model_believes() {
        let mut tasks = [(0.5, 1.0), (0.5, 0.0)].map(|(understood, believed)| Weighed { understood, believed, ..Weighed::default() });
        pool(&mut tasks);
        assert_eq!(tasks.map(|task| task.believed), [0.9, 0.1]);
    }

    #[test]
    fn tasks_that_were_meant_in_a_scene_share_out_what_they_have_together() {
        let task = |understood, itself| Weighed { understood, itself, ..Weighed::default() };
        let believed = |itself: [Option<f32>; 3]| {
            let mut tasks = [task(0.5, itself[0]), task(0.3, itself[1]), task(0.2, itself[2])];
            weigh(&mut tasks, 1.0);
            tasks.map(|task| task.believed)
        };
        let (before, after) = (believed([None; 3]), believed([Some(-1.0), Some(1.0), None]));
        assert_eq!(before[2], after[2]);
        assert!((before[0] + before[1] - after[0] - after[1]).abs() < 1e-6);
        assert!(before[0] > before[1] && after[0] < after[1]);
    }
}
