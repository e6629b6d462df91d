"""What must hold for every response of the joint query, clause by clause, in every scenario."""

from __future__ import annotations

import math
from itertools import pairwise

from autograder.authoring import (
    JOINTS,
    Call,
    Transcript,
    answered_within,
    answers_without_waiting,
    calls,
    ev,
    known_messages,
    lesson_on_subscribing,
    obligation,
    shown_fields,
    whole_run,
)

from . import advice, truth
from .advice import asked, contains_name, described, listed, quoted

SERVICE = "get_joint_positions"
# A busy machine may delay some messages, but not most of them. If at least MIN_PAIRS responses have a predecessor and
# more than MAX_STALE of them equal it, the node responds from an old table. (Measured: 0 of 11 for a correct node, also
# at a load of 8; 8 of 11 for a table that is renewed twice a second.)
MIN_PAIRS, MAX_STALE = 6, 0.4


def _knowledge(call: Call) -> str:
    return "after the first message" if truth.must_know(call) else "before the first message"


answers_in_time = answered_within(2.0, SERVICE, clause=6)
never_waits = answers_without_waiting(SERVICE, _knowledge, clause=6)


@obligation(1, 2, of=calls(SERVICE), see="01_robot_and_graph#joints-intro")
def finds_the_joints(call: Call) -> str | None:
    """If the request has only joints of the robot, or no names, the response has success true"""
    if not truth.ought_to_succeed(call):
        return None
    unsubscribed = truth.is_unsubscribed(call)
    call.require(
        call.response.success,
        expected=f"success: true for {asked(call)}, which the robot has",
        observed=shown_fields(call.response, "success", "message"),
        help=advice.not_heard(call) if unsubscribed else advice.on_refusal(call),
        see=lesson_on_subscribing(call.run, "joint_states"),
    )
    return "without a subscription" if unsubscribed else truth.situation(call)


def _is_a_success(call: Call) -> bool:
    """Return whether a call that should succeed did; require it if no call of the run succeeded."""
    if not truth.ought_to_succeed(call):
        return False
    answered = [each for each in call.run.all(ev.ServiceAnswered) if getattr(each.response, "success", False)]
    if not answered:
        finds_the_joints.require(call)
    return call.response.success


def _require_heard(call: Call) -> None:
    """Require that a node without a subscription to joint_states does not respond with joints."""
    if not truth.is_unsubscribed(call):
        return
    joints = call.response.joint_state
    call.require(
        not call.response.success,
        expected="a response from the robot's joint_states",
        observed=f"{described(joints.name, joints.position)}, although your node had received no joint_states",
        help=advice.not_heard(call),
        see=lesson_on_subscribing(call.run, "joint_states"),
    )


@obligation(1, of=calls(SERVICE), see="01_robot_and_graph#joints-run")
def keeps_the_order_asked(call: Call) -> str | None:
    """joint_state.name has the names of the request in the same order, including repeated ones"""
    wanted, names = list(call.request.names), list(call.response.joint_state.name)
    if not wanted or not _is_a_success(call):
        return None
    call.require(
        names == wanted,
        expected=f"joint_state.name as in the request: {listed(wanted)}",
        observed=listed(names),
        help=advice.on_names(call, names, wanted),
    )
    return "a name twice" if len(set(wanted)) < len(wanted) else "different names"


@obligation(2, of=calls(SERVICE), see="01_robot_and_graph#joints-intro")
def lists_every_joint_once(call: Call) -> str | None:
    """For an empty list the response has every joint of the robot, once"""
    _require_heard(call)
    if call.request.names or not _is_a_success(call):
        return None
    names, joints = list(call.response.joint_state.name), truth.robot_joints(call.run)
    missing = sorted(set(joints) - set(names))
    call.require(
        sorted(names) == sorted(joints),
        expected=f"all {len(joints)} joints of the robot, each once, in any order",
        observed=f"{len(names)} names; missing: {listed(missing)}",
        help="If request.names is empty, use every name of the last joint_states instead.",
    )
    return "all joints"


@obligation(1, 2, 5, of=calls(SERVICE), see="01_robot_and_graph#joints-run")
def positions_are_the_last(call: Call) -> str | None:
    """Each position is that of the joint with the same index, unchanged from the last joint_states"""
    names, positions = list(call.response.joint_state.name), list(call.response.joint_state.position)
    _require_heard(call)
    if not _is_a_success(call) or not (call.request.names or names):
        return None
    missing = [name for name in call.request.names if name not in names]
    call.require(
        len(names) == len(positions) > 0 and not missing,
        expected=f"a position for each of {asked(call)}, and as many positions as names",
        observed=f"{len(names)} names and {len(positions)} positions"
        + (f", none for {listed(missing)}" if missing else ""),
        help="Fill joint_state.name and joint_state.position together, with one pair for every name of the request."
        + advice.about_repeats(call),
    )
    tables = [truth.positions_by_name(message) for message in known_messages(call, JOINTS) or ()]
    off = min(
        ([i for i, at in enumerate(positions) if not truth.is_at(names[i], at, table)] for table in tables),
        key=len,
    )
    wrong, last = [names[i] for i in off], tables[-1]
    call.require(
        not off,
        expected=f"the last joint_states: {described(wrong, [last.get(name, math.nan) for name in wrong])}",
        observed=described(wrong, [positions[i] for i in off]),
        help=advice.on_positions(call, names, positions, last),
    )
    return truth.situation(call)


@obligation(5, of=calls(SERVICE), see="01_robot_and_graph#joints-run")
def goes_by_names_not_places(call: Call) -> str | None:
    """When joint_states changes the order of joints, every position is still that of its joint"""
    orders = [message.names for message in known_messages(call, JOINTS) or ()]
    changed = any(names != truth.robot_joints(call.run) for names in orders)
    return finds_the_joints.require(call) and positions_are_the_last.require(call) if changed else None


@obligation(5, of=whole_run)
def keeps_up_with_a_motion(run: Transcript) -> str | None:
    """While a joint moves, responses differ from one to the next, as they come from the last message"""
    answers = [call for call in calls(SERVICE)(run) if _is_a_success(call)]
    pairs = [(one, other) for one, other in pairwise(answers) if truth.moved_between(one, other)]
    if len(pairs) < MIN_PAIRS:
        return None
    same = [other for one, other in pairs if other.response.joint_state == one.response.joint_state]
    (same or answers)[0].require(
        len(same) <= MAX_STALE * len(pairs),
        expected=f"a different response each time, as {asked(pairs[0][0])} moved and new joint_states came in between",
        observed=f"{len(same)} of {len(pairs)} responses were equal to the one before",
        help="Store every joint_states message when it comes, and look up the joints in it in each request.",
    )
    return "while a joint moves"


@obligation(3, of=calls(SERVICE), see="02_services#set-refuse-why")
def refuses_unknown_joints(call: Call) -> str | None:
    """If the request has a name that is not exactly that of a joint, the response has success false"""
    _require_heard(call)
    if not truth.must_know(call) or not (unknown := truth.unknown_names(call)):
        return None
    message = call.response.message
    call.require(
        not call.response.success,
        expected=f"success: false for {asked(call)}, because the robot has no {quoted(unknown)}",
        observed=shown_fields(call.response, "success", "message"),
        help="Your message has the unknown joints, but success is true: leave response.success False."
        if any(contains_name(message, name) for name in unknown if name)
        else advice.on_strangers(call, unknown),
    )
    return "among known ones" if len(set(unknown)) < len(set(call.request.names)) else "only unknown ones"


@obligation(3, of=calls(SERVICE))
def names_every_unknown_joint(call: Call) -> str | None:
    """With success false, the message contains every unknown name exactly as in the request"""
    if not truth.must_know(call) or not (unknown := truth.unknown_names(call)) or call.response.success:
        return None
    message = call.response.message
    unnamed = [name for name in unknown if not contains_name(message, name)]
    call.require(
        not unnamed,
        expected=f"a message with every unknown joint: {quoted(unknown)}",
        observed=f"{message[:200]!r}, without {quoted(unnamed)}",
        help="Collect all unknown names of the request before you respond, instead of stopping at the first."
        if len(unnamed) < len(unknown)
        else "Write the unknown names of this request into response.message, unchanged.",
    )
    return "one unknown" if len(set(unknown)) == 1 else "several unknown"


@obligation(4, of=calls(SERVICE))
def says_when_it_knows_nothing(call: Call) -> str | None:
    """Before the first joint_states every response has success false"""
    if truth.is_unsubscribed(call) or known_messages(call, JOINTS) != []:
        return None
    call.require(
        not call.response.success,
        expected=f"success: false for {asked(call)}, because the robot has not published its joints yet",
        observed=shown_fields(call.response, "success", "message"),
        help="Initialise the stored message with None, and set success to false while it is None.",
    )
    return "names" if call.request.names else "all joints"
