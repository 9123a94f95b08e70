//! The role model: each word is background, speaks of the kind of task, or names a value of something in a role.
//!
//! The role depends on the word before ("to", "from", "through") and on the *memory*, the role that was named last. With m the memory, w'
//! the word before and l the lifted task:
//!
//! ```text
//! Pr(r | m, w', l)  = (1 - end[l,m]) p0[l,m,r] lift[w',kind(r)] / (sum of p0 lift over background, task and the task's roles)
//! Pr(w | background) = F(w)      Pr(w | task) = A[l](w)
//! Pr(w | role r)    = sum over the groups g of r of lambda[r,g] / (sum of r's lambda) times the mean of T[v](w) over the group's values v
//! ```
//!
//! Background and task words leave the memory unchanged; a role becomes the memory. Pr(e|t) is the sum over all ways to read the words,
//! times `end[l,m]` for the last memory. If tasks have ways, a few more words before also have a factor (their cues), and so does how much
//! of each role is named (naming).
//!
//! The probability of an unseen word in a row of F, A or T is the row's novelty, 1 / (sum of its counts + 1), so it most likely names a
//! value that nobody has named yet.
//!
//! - [`layout`]: the position of each parameter in the two tables;
//! - [`forward`]: Pr(e|t), word by word. After each word, memories with less than a thousandth of the probability are dropped: they take
//!   most of the work and change next to nothing;
//! - `start`: the parameters that training starts from, computed from how often words and values occur together;
//! - [`training`]: expectation maximisation, in parts;
//! - [`kind`]: the kind of task that the words speak of, whatever is in the scene;
//! - `data`: memory for the training data;
//! - `talk`: commands with words around them, and how much of a task is named;
//! - `names`: how often a word was taken for a value;
//! - `whole`: what lessons with exactly the same words meant;
//! - [`explanation`]: what each word was taken for.

pub(crate) mod data;
pub mod explanation;
pub mod forward;
pub mod kind;
pub mod layout;
#[cfg(feature = "layer")]
pub mod names;
mod start;
#[cfg(feature = "talk")]
pub(crate) mod talk;
pub mod training;
pub mod whole;

pub use explanation::Meaning;
pub use layout::Layout;
