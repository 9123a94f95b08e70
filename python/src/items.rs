//! Lists that Python gives.

use crate::error::value;
use pyo3::conversion::FromPyObjectOwned;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};

/// The most items of a list: an object may go on for ever.
const MOST: usize = 1 << 20;

/// The items of a list, a tuple or anything else that has items in order. Room is made as they come: the length that an object says it has may
/// be any number, and room for 10^12 items ends the process.
#[derive(Clone, Debug, Default)]
pub struct Items<T>(pub Vec<T>);

impl<'py, T: FromPyObjectOwned<'py>> FromPyObject<'_, 'py> for Items<T> {
    type Error = PyErr;

    fn extract(given: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if given.is_instance_of::<PyString>() || given.is_instance_of::<PyDict>() {
            return Err(PyTypeError::new_err(format!("a list is wanted here, and not a {}", given.get_type().name()?)));
        }
        let mut items = Vec::new();
        for item in given.try_iter()? {
            if items.len() == MOST {
                return Err(value(format!("the list has more than {MOST} items; give fewer")));
            }
            items.push(item?.extract::<T>().map_err(Into::into)?);
        }
        Ok(Self(items))
    }
}
