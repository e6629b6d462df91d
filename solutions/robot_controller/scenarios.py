"""Scripted servers for a robot controller. No expected responses here: this runs in the arena."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from typing import Any

from std_srvs.srv import SetBool, Trigger

from autograder.arena.client_stage import ClientStage
from autograder.arena.scripted_service import SILENCE, Reply, ScriptedService

RETRY_TIMEOUT = 5.0  # s from the first request to a second one
TICK = 0.03  # s
RUN_TIMEOUT = 25.0  # s
TYPES = {"SetBool": SetBool, "Trigger": Trigger}

# The script of one service, or None for no server. Keys, all but the first optional:
#   replies: for each request [success, message, s until it is sent], or None for no reply; the last one is repeated
#   appears: s after the program's node; servers: their number; type: another type
#   dies_after: number of requests; returns: s after its death, with the replies `then`
Script = Mapping[str, Any]


class Play:
    """The servers of one service, which appear and die according to a script."""

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
    """Offer the services of the scripts, and run the program until it exits."""
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
    """Each server appears `appears` s after the client begins to wait for it; get_status never responds.

    enable_motors responds only to the second request, after `answers` s. For a client that waits for both servers
    first, get_status appears that long after enable_motors; for others, that long after the response of enable_motors.
    """
    stage.start_program()
    stage.wait(appears)
    enable = stage.offer_service(
        "enable_motors",
        SetBool,
        SILENCE,
        Reply(SetBool.Response(success=True, message="the motors are on"), answers),
    )
    if stage.wait_for_requests(enable, 1, appears) and stage.wait_for_requests(enable, 2, RETRY_TIMEOUT):
        stage.wait(answers + appears)
    stage.offer_service("get_status", Trigger, SILENCE)
    stage.wait_for_end()
