//! Numbers as numpy arrays: numpy reads the bytes, so that the wheel is built without it.

use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyBytes, PyModule};

fn numpy(py: Python<'_>) -> PyResult<&Bound<'_, PyModule>> {
    static NUMPY: PyOnceLock<Py<PyModule>> = PyOnceLock::new();
    Ok(NUMPY.get_or_try_init(py, || py.import("numpy").map(Bound::unbind))?.bind(py))
}

/// A type of number that numpy has.
pub trait Element: Copy {
    /// numpy's name for it.
    const NAME: &'static str;
    /// Its bytes, in this machine's order.
    fn write(self, bytes: &mut Vec<u8>);
}

macro_rules! element {
    ($($type:ty = $name:literal),*) => {
        $(impl Element for $type {
            const NAME: &'static str = $name;
            fn write(self, bytes: &mut Vec<u8>) {
                bytes.extend_from_slice(&self.to_ne_bytes());
            }
        })*
    };
}
element!(f32 = "float32", i64 = "int64");

impl Element for bool {
    const NAME: &'static str = "bool";
    fn write(self, bytes: &mut Vec<u8>) {
        bytes.push(u8::from(self));
    }
}

/// The numbers, row by row, as a new array of this shape; it cannot be written to.
pub fn array<'py, E: Element>(py: Python<'py>, numbers: impl IntoIterator<Item = E>, shape: &[usize]) -> PyResult<Bound<'py, PyAny>> {
    let mut bytes = Vec::with_capacity(shape.iter().product::<usize>().saturating_mul(size_of::<E>()));
    numbers.into_iter().for_each(|number| number.write(&mut bytes));
    let flat = numpy(py)?.call_method1("frombuffer", (PyBytes::new(py, &bytes), E::NAME))?;
    flat.call_method1("reshape", (shape.to_vec(),))
}
