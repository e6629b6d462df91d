"""A response of the joint query is compared with every message that may have been the latest one."""

import pytest

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure
from autograder.engine.exercise import exercise_module
from humanoid_interfaces.srv import GetJointPositions
from ros_runtime.record.client_events import ServiceAnswered, ServiceCalled

MODEL = exercise_module("joint_query", "model")
JOINTS = {"l_elbow": -1.25, "r_elbow": 0.0, "head_pan": 0.5}  # rad


def published(start, end, *, rate=0.0, order=1):
    """Return messages 20 times a second; head_pan turns at a rate (rad/s)."""
    times = [start + 0.05 * number for number in range(round((end - start) / 0.05))]
    for t in times:
        positions = {**JOINTS, "head_pan": JOINTS["head_pan"] + rate * (t - start)}
        names = list(positions)[::order]
        yield ev.JointsPublished(t=t, names=names, positions=[positions[name] for name in names])


def asked(t, names, *, positions=None, success=True, message="", number=1):
    """Return a request and its answer; its positions are by name, or those of the robot at the start."""
    answered = names or list(JOINTS)
    response = GetJointPositions.Response(success=success, message=message)
    if success:
        response.joint_state.name = list(answered)
        values = positions or [JOINTS.get(name, 0.0) for name in answered]
        response.joint_state.position = [float(value) for value in values]
    call, service = f"get_joint_positions {number}", "get_joint_positions"
    request = GetJointPositions.Request(names=list(names))
    yield ServiceCalled(t=t, call=call, service=service, request=request)
    yield ServiceAnswered(t=t + 0.01, call=call, response=response)


def judge(obligation, *events, steps=()):
    run = Transcript.from_events(
        "in_order",
        {"steps": list(steps)},
        [
            ev.NodeStarted(t=0.0),
            ev.NodeReady(t=0.1, waited=0.1),
            *(each for group in events for each in group),
        ],
    )
    return getattr(MODEL, obligation).judge(run)


def test_a_name_that_was_asked_for_twice_is_answered_twice():
    messages = list(published(0.2, 3.0))
    assert judge("keeps_the_order_asked", messages, asked(2.5, ["r_elbow", "l_elbow", "r_elbow"])) == {
        "a name twice": 1
    }
    once = [*asked(2.5, ["r_elbow", "l_elbow", "r_elbow"])]
    once[1].response.joint_state.name = ["r_elbow", "l_elbow"]
    with pytest.raises(Failure) as failure:
        judge("keeps_the_order_asked", messages, once)
    assert failure.value.help.endswith("A name that is twice in the request is twice in the response.")


@pytest.mark.parametrize("away", [0.0, 4e-6])
def test_positions_are_as_they_came(away):
    right = asked(2.5, ["l_elbow"], positions=[-1.25 + away])
    assert judge("positions_are_the_last", published(0.2, 3.0), right) == {"a recent message": 1}


@pytest.mark.parametrize(
    ("position", "advice"),
    [(-1.253, "almost right"), (1.25, "Only the signs"), (-71.6, "degrees"), (0.5, "belong to other joints")],
)
def test_the_advice_on_positions_names_the_mistake(position, advice):
    with pytest.raises(Failure) as failure:
        judge("positions_are_the_last", published(0.2, 3.0), asked(2.5, ["l_elbow"], positions=[position]))
    assert advice in failure.value.help


def test_before_the_first_message_nothing_is_known():
    unplugged = [["ask", []], ["plug_in"]]
    refused = judge("says_when_it_knows_nothing", asked(2.0, [], success=False), steps=unplugged)
    assert refused == {"all joints": 1}
    with pytest.raises(Failure, match="has not published"):
        judge("says_when_it_knows_nothing", asked(2.0, ["l_elbow"]), steps=unplugged)


def test_a_node_that_does_not_subscribe_fails():
    with pytest.raises(Failure, match="success: true"):
        judge("finds_the_joints", asked(2.0, ["l_elbow"], success=False), steps=[["let_arrive"]])
    with pytest.raises(Failure, match="your node had received no joint_states"):
        judge("positions_are_the_last", asked(2.0, ["l_elbow"]), steps=[["let_arrive"]])


def test_while_no_messages_come_the_last_one_stays_the_answer():
    off = ev.RobotCommanded(t=3.0, command={"do": "joint_sensors", "connected": False})
    heard = [*published(0.2, 3.0), off]
    assert judge("finds_the_joints", heard, asked(14.0, ["l_elbow"])) == {"a pause of 10 s or more": 1}
    with pytest.raises(Failure) as failure:
        judge("finds_the_joints", heard, asked(14.0, ["l_elbow"], success=False))
    assert "however old it is" in failure.value.help


@pytest.mark.parametrize("name", ["elbow", "R_Elbow", " r_elbow", "r_elbow ", "", "tail"])
def test_names_count_letter_by_letter(name):
    messages = list(published(0.2, 3.0))
    assert judge("refuses_unknown_joints", messages, asked(2.5, ["l_elbow", name], success=False))
    with pytest.raises(Failure, match="success: false"):
        judge("refuses_unknown_joints", messages, asked(2.5, ["l_elbow", name]))


@pytest.mark.parametrize("message", ["no r_elbow", "no such joint: r_elbow_2", "l_elbow, which is known"])
def test_a_part_of_a_joints_name_does_not_name_it(message):
    with pytest.raises(Failure, match="without elbow"):
        judge(
            "names_every_unknown_joint",
            published(0.2, 3.0),
            asked(2.5, ["elbow"], success=False, message=message),
        )


@pytest.mark.parametrize(("period", "is_stale"), [(0.05, False), (0.5, True), (2.0, True)])
def test_a_cache_that_is_refreshed_at_intervals_is_detected(period, is_stale):
    def answers():
        for number in range(12):
            t = 2.5 + 0.15 * number
            known = t - t % period - 0.2
            yield from asked(t, ["head_pan"], positions=[0.5 + 0.3 * known], number=number)

    if is_stale:
        with pytest.raises(Failure, match="equal to the one before"):
            judge("keeps_up_with_a_motion", published(0.2, 5.0, rate=0.3), answers())
    else:
        assert judge("keeps_up_with_a_motion", published(0.2, 5.0, rate=0.3), answers())
