//! The agent's decision.

use pyo3::prelude::*;
use pyo3::types::PyString;

/// The agent's next action, and the task that it is for.
#[pyclass(frozen, module = "goodbot")]
#[derive(Debug)]
pub struct Decision {
    pub action: String,
    /// The task, by its position among `Agent.tasks`.
    #[pyo3(get)]
    pub task: usize,
    /// The kind of plan for the task: `goal`, `toward`, `dead end`, `approximate` or `unknown`.
    #[pyo3(get)]
    pub plan: String,
    pub name: Py<PyString>,
}

/// For pickle: the function that makes a decision again, and its arguments.
type Reduced<'py> = (Bound<'py, PyAny>, (String, usize, String, Py<PyString>));

#[pymethods]
impl Decision {
    /// The name of the action; `noop` at the goal, in a dead end, and where no way is known.
    #[getter]
    fn action<'py>(&self, py: Python<'py>) -> Bound<'py, PyString> {
        PyString::intern(py, &self.action)
    }

    /// The task, by its name.
    #[getter]
    fn name(&self, py: Python<'_>) -> Py<PyString> {
        self.name.clone_ref(py)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let Self { action, task, plan, name } = slf.get();
        Ok((slf.get_type().getattr("_restored")?, (action.clone(), *task, plan.clone(), name.clone_ref(slf.py()))))
    }

    #[staticmethod]
    fn _restored(action: String, task: usize, plan: String, name: Py<PyString>) -> Self {
        Self { action, task, plan, name }
    }

    fn __repr__(&self) -> String {
        format!("<goodbot.Decision: {} for {}, {}>", self.action, self.name, self.plan)
    }
}
