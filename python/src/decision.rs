//! The agent's decision.

use goodbot::planning::OptimalSet;
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
    pub plan: OptimalSet,
    pub name: Py<PyString>,
}

#[pymethods]
impl Decision {
    /// The name of the action; `noop` at the goal, in a dead end, and where no way is known.
    #[getter]
    fn action<'py>(&self, py: Python<'py>) -> Bound<'py, PyString> {
        PyString::intern(py, &self.action)
    }

    /// The kind of plan for the task: `goal`, `toward`, `dead end`, `approximate` or `unknown`.
    #[getter]
    fn plan(&self) -> &'static str {
        self.plan.name()
    }

    /// The task, by its name.
    #[getter]
    fn name(&self, py: Python<'_>) -> Py<PyString> {
        self.name.clone_ref(py)
    }

    fn __repr__(&self) -> String {
        format!("<goodbot.Decision: {} for {}, {}>", self.action, self.name, self.plan.name())
    }
}
