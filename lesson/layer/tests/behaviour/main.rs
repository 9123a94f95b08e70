//! What the layer understands, and when it must not change anything.

mod growth;
mod layer;
