"""A robot that learns what your words mean from reward and punishment.

You tell it in your own words what to do, say "good bot" or "bad bot" while it tries, and it learns what your words mean.

>>> import goodbot
>>> home = goodbot.Home.from_map('''
... #########
... #ggg#rrr#
... ##+###+##
... #bb@bbbb#
... #########
... ''')
>>> agent, trainer = goodbot.Agent(seed=1), goodbot.Trainer(seed=1)
>>> lesson = trainer.teach(agent, home, home.start, "go to the green room", "agentInRoom(agent0,room1)")
>>> lesson = trainer.teach(agent, home, home.start, "go to the red room", "agentInRoom(agent0,room2)")
>>> lesson.ending
'goal'
>>> agent.hear(home, home.start, "the red one please")      # words in an order that was never taught
>>> agent.most_likely
'agentInRoom(agent0,room2)'

- `Home`, `State`: the paper's homes, and where things are in them; `Domain`: a robot of your own, as a class;
- `World`: a robot of any kind, from a file or a dict;
- `Agent`, `Decision`: the robot's mind;
- `Trainer`, `Lesson`: a simulated trainer;
- `teach`, `Judge`, `LanguageModel`: a lesson with a trainer or a language model of your own;
- `Session`, `read_log`, `write_log`: recorded sessions; `posteriors`: the beliefs in them; `learn`: an agent trained on them;
- `goodbot.datasets`: logs that you fetch, with their checksums, and splits;
- `evaluate`, `Evaluation`: how well unseen commands are understood;
- `exercises`, `run_course`, `run_courses`: the paper's experiment; `study`, `Study`: agents compared;
- `goodbot.sklearn`: a classifier of sentences;
- `goodbot.gym`: the homes as Gymnasium environments.
"""

from . import datasets
from ._native import (
    Agent,
    CapacityError,
    Decision,
    FormatError,
    Home,
    InternalError,
    InUseError,
    Lesson,
    ModelError,
    Session,
    SessionError,
    State,
    Trainer,
    World,
    Worlds,
    __version__,
    capacities,
    exercises,
    words,
)
from .domain import Domain
from .evaluation import Evaluation, evaluate
from .experiment import run_course, run_courses
from .language import LanguageModel, LearningLanguageModel, Task, hear
from .learning import learn
from .lesson import Judge, Step, Taught, teach
from .logs import Posterior, posteriors, read_log, write_log
from .registration import register
from .studies import Study, study

register()

__all__ = [
    "Agent",
    "CapacityError",
    "Decision",
    "Domain",
    "Evaluation",
    "FormatError",
    "Home",
    "InUseError",
    "InternalError",
    "Judge",
    "LanguageModel",
    "LearningLanguageModel",
    "Lesson",
    "ModelError",
    "Posterior",
    "Session",
    "SessionError",
    "State",
    "Step",
    "Study",
    "Task",
    "Taught",
    "Trainer",
    "World",
    "Worlds",
    "__version__",
    "capacities",
    "datasets",
    "evaluate",
    "exercises",
    "hear",
    "learn",
    "posteriors",
    "read_log",
    "run_course",
    "run_courses",
    "study",
    "teach",
    "words",
    "write_log",
]
