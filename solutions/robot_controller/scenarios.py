"""Servers for a robot controller to deal with. No expected answers here: this runs in the arena."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from typing import Any

from std_srvs.srv import SetBool, Trigger

from autograder.arena.client_stage import ClientStage
from autograder.arena.scripted_service import SILENCE, Reply, ScriptedService

END_OF_A_CALL = 5.0  # s from the first request, for a second one
TICK = 0.03  # s
RUN_TIMEOUT = 25.0  # s
TYPES = {"SetBool": SetBool, "Trigger": Trigger}

# What is known of one service: None, or some of
#   replies: each None for silence, or [success, message, s until it is sent]; the last one is repeated
#   appears: s after the program's node; servers: how many; type: another one
#   dies_after: requests; returns: s after its death, with the replies `then`
Script = Mapping[str, Any]


class Play:
    """The servers of one service, which come and go as a script says."""

    def __init__(self, stage: ClientStage, name: str, type_name: str, script: Script) -> None:
        self._stage, self._name, self._script = stage, name, script
        self._type = TYPES[script.get("type", type_name)]
        self._servers: list[ScriptedService] = []
        self._died_at: float | None = None
        if not script.get("appears"):
            self._offer(script["replies"])

    def go_on(self, t: float) -> None:
        """Do what is due `t` s after the program's node appeared."""
        script = self._script
        if not self._servers and t >= script.get("appears", 0.0):
            self._offer(script["replies"])
        if (
            self._died_at is None
            and self._servers
            and self._servers[0].requests >= script.get("dies_after", 99)
        ):
            for server in self._servers:
                server.withdraw()
            self._died_at = t
        if self._died_at is not None and "returns" in script and t >= self._died_at + script["returns"]:
            self._offer(script["then"])
            self._died_at = float("inf")

    def _offer(self, replies: Sequence[Sequence[Any] | None]) -> None:
        made = [
            SILENCE if each is None else Reply(self._type.Response(success=each[0], message=each[1]), each[2])
            for each in replies
        ]
        for _ in range(self._script.get("servers", 1)):
            self._servers.append(self._stage.offer_service(self._name, self._type, *made))


def servers(stage: ClientStage, enable: Script | None = None, status: Script | None = None) -> None:
    """Offer what the scripts say, run the program, and let servers come and go until it ends."""
    wanted = (("enable_motors", "SetBool", enable), ("get_status", "Trigger", status))
    plays = [Play(stage, name, type_name, script) for name, type_name, script in wanted if script is not None]
    stage.start_program()
    started = time.monotonic()
    while not stage.has_ended() and (t := time.monotonic() - started) < RUN_TIMEOUT:
        for play in plays:
            play.go_on(t)
        stage.wait_until(stage.has_ended, TICK)
    stage.wait_for_end()


def late_and_silent(stage: ClientStage, appears: float, answers: float) -> None:
    """Each server appears `appears` s after the client could look for it; enable_motors is slow, get_status silent.

    enable_motors answers the second request, `answers` s after it. A client that waits for both servers before it asks
    gets get_status that long after enable_motors, any other that long after the answer of enable_motors.
    """
    stage.start_program()
    stage.wait(appears)
    enable = stage.offer_service(
        "enable_motors",
        SetBool,
        SILENCE,
        Reply(SetBool.Response(success=True, message="the motors are on"), answers),
    )
    if stage.wait_for_requests(enable, 1, appears) and stage.wait_for_requests(enable, 2, END_OF_A_CALL):
        stage.wait(answers + appears)
    stage.offer_service("get_status", Trigger, SILENCE)
    stage.wait_for_end()
