"""A ROS 2 node around a goodbot agent: say a command, watch the robot go, reward or punish it, and ask what it believes.

    python ros2_node.py --ros-args -p home:=home.json -p model:=words.goodbot

| name | kind | type | what |
|---|---|---|---|
| `command` | topic, in | `std_msgs/String` | what to do, in a person's words; a command that is under way is dropped |
| `feedback` | topic, in | `std_msgs/Int8` | of the last action: 1 good, -1 bad, 0 nothing |
| `done` | topic, in | `std_msgs/Empty` | the command is carried out: learn from it |
| `pose` | topic, in | `geometry_msgs/Point` | the robot's cell, if it senses that |
| `action` | topic, out | `std_msgs/String` | what the robot does next: north, south, east, west or noop |
| `believed` | service | `std_srvs/Trigger` | what the command is believed to mean, as JSON |
| `save` | service | `std_srvs/Trigger` | writes the model to the file of the parameter `model` |

The agent acts once a `period` (seconds). The trainer's word counts until the next action, as in the paper.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import rclpy
from geometry_msgs.msg import Point
from rclpy.node import Node
from std_msgs.msg import Empty, Int8, String
from std_srvs.srv import Trigger

import goodbot
from goodbot.names import Feedback

WORDS: dict[int, Feedback] = {1: "reward", -1: "punish", 0: "neutral"}


class GoodbotNode(Node):
    """The node: one home, one agent, and the command under way."""

    def __init__(self) -> None:
        super().__init__("goodbot")
        home = self.declare_parameter("home", "home.json").value
        self.model = Path(self.declare_parameter("model", "words.goodbot").value)
        period = self.declare_parameter("period", 1.0).value
        self.home = goodbot.Home.from_json(Path(home).read_text(encoding="utf-8"))
        self.state = self.home.start
        self.agent = goodbot.Agent.load(self.model) if self.model.exists() else goodbot.Agent()
        self.listening = False

        self.actions = self.create_publisher(String, "action", 10)
        self.create_subscription(String, "command", self.on_command, 10)
        self.create_subscription(Int8, "feedback", self.on_feedback, 10)
        self.create_subscription(Empty, "done", self.on_done, 10)
        self.create_subscription(Point, "pose", self.on_pose, 10)
        self.create_service(Trigger, "believed", self.on_believed)
        self.create_service(Trigger, "save", self.on_save)
        self.create_timer(period, self.on_timer)

    def refused(self, refusal: Exception) -> None:
        """Logs a refusal; the node goes on."""
        self.get_logger().warning(str(refusal))

    def on_command(self, message: Any) -> None:
        """Hears a command in the current state."""
        try:
            self.agent.hear(self.home, self.state, message.data)
            self.listening = True
        except (ValueError, RuntimeError) as refusal:
            self.listening = False
            self.refused(refusal)

    def on_feedback(self, message: Any) -> None:
        """Takes in the trainer's feedback to the last action."""
        try:
            self.agent.feedback(WORDS[max(-1, min(1, message.data))])
        except RuntimeError as refusal:
            self.refused(refusal)

    def on_pose(self, message: Any) -> None:
        """Records the sensed cell of the robot."""
        agent = next(name for name, it in self.home.objects.items() if it["class"] == "agent")
        try:
            self.state = self.home.placed(self.state, {agent: (round(message.x), round(message.y))})
        except ValueError as refusal:
            self.refused(refusal)

    def on_done(self, _message: Any) -> None:
        """Ends the command, and learns from it."""
        if self.listening:
            self.listening = False
            self.agent.finish(self.home)

    def on_timer(self) -> None:
        """Decides on the next action and publishes it."""
        if not self.listening:
            return
        self.agent.plan(self.home, self.state)
        decision = self.agent.decide(self.home, self.state)
        self.state = self.agent.acted(self.home, self.state, decision.action)
        self.actions.publish(String(data=decision.action))

    def on_believed(self, _request: Any, response: Any) -> Any:
        """Tells how probable each task is."""
        beliefs = {task: float(share) for task, share in zip(self.agent.tasks, self.agent.beliefs, strict=True)}
        response.success, response.message = self.listening, json.dumps({"command": self.agent.command, "tasks": beliefs})
        return response

    def on_save(self, _request: Any, response: Any) -> Any:
        """Writes the model."""
        try:
            self.agent.save(self.model)
            response.success, response.message = True, f"{self.agent.sessions} sessions in {self.model}"
        except (OSError, ValueError) as refusal:
            response.success, response.message = False, str(refusal)
        return response


def main() -> None:
    """Runs the node until it is stopped."""
    rclpy.init()
    node = GoodbotNode()
    try:
        rclpy.spin(node)
    finally:
        node.destroy_node()
        rclpy.shutdown()


if __name__ == "__main__":
    main()
