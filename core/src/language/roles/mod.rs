//! The role model: a word is background, speaks of the kind of task, or names a value of something in a role.
//!
//! Which role depends on the word before ("to", "from", "through") and on the role that was named last, the memory. With m the memory, w' the
//! word before and l the lifted task:
//!
//! ```text
//! Pr(r | m, w', l)  = (1 - end[l,m]) p0[l,m,r] lift[w',kind(r)] / (sum of p0 lift over the roles that the task has)
//! Pr(w | background) = F(w)      Pr(w | task) = A[l](w)
//! Pr(w | role r)    = sum over the groups g of r of lambda[r,g] / (sum of r's lambda) times the mean of T[v](w) over the group's values v
//! ```
//!
//! Background and task words leave the memory as it is; a role becomes the memory. Pr(e|t) is the sum over all ways to read the words, the
//! last memory times `end[l,m]`.
//!
//! A word that was never heard is as probable for each row of F, A and T as the row is open to new words, 1 / (sum of its counts + 1): a value that
//! nobody has named yet takes it first.
//!
//! - [`layout`]: where each parameter is in the two tables;
//! - [`forward`]: Pr(e|t), word by word. Memories of less than a thousandth of all are dropped after each word: they take most of the work
//!   and change next to nothing;
//! - `start`: where training begins, from how often words and values come together;
//! - [`training`]: expectation maximisation, in parts;
//! - [`kind`]: which kind of task the words speak of, whatever is in the scene;
//! - `data`: the room that training data take;
//! - `talk`: with words around the command, and how much of a task is named;
//! - `names`: how often a word was taken for a value;
//! - [`explanation`]: what each word was taken for.

pub(crate) mod data;
pub mod explanation;
pub mod forward;
pub mod kind;
pub mod layout;
#[cfg(feature = "layer")]
pub(crate) mod names;
mod start;
#[cfg(feature = "talk")]
pub(crate) mod talk;
pub mod training;

pub use explanation::Meaning;
pub use layout::Layout;
