#!/usr/bin/env python3
"""The mission as an action: the conditions of ~start, feedback, a result with its cause, a zero first when it is cancelled in
any state; and ~enable."""
import os
import pathlib
import re
import signal
import subprocess
import sys
import time
import unittest

import actionlib
import rospkg
import rospy
import rostest
from actionlib import CommState
from actionlib_msgs.msg import GoalStatus
from geometry_msgs.msg import Twist, TwistStamped, Vector3
from std_msgs.msg import Header
from std_srvs.srv import SetBool
from window_ingress.msg import IngressAction, IngressActionResult, IngressGoal, IngressResult, IngressState

import plant
import support

GLASS_FREE = {"glass": IngressGoal.GLASS_EXCLUDED}
# Inserted before a client's program: its send_goal returns a second after the goal was sent, when the answer has arrived.
ANSWERED_FIRST = """
import threading, time, actionlib.action_client
_handle = actionlib.action_client.ClientGoalHandle
def _late(machine):
    time.sleep(1.0 if threading.current_thread() is threading.main_thread() else 0.0)
    return _handle(machine)
actionlib.action_client.ClientGoalHandle = _late
"""
STALE_WITHIN_S = 0.6  # limit of the age, plus margin for a loaded machine


def call(service):
    return support.call(f"ingress_navigator/{service}")


def enable(data):
    rospy.wait_for_service("ingress_navigator/enable", support.DEADLINE_S)
    return rospy.ServiceProxy("ingress_navigator/enable", SetBool)(data)


class MissionActionTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.plant = plant.Plant()
        cls.states = support.Listener("state", IngressState)
        cls.setpoints = support.Listener("cmd_vel", TwistStamped)
        cls.results = support.Listener("ingress/result", IngressActionResult)
        cls.client = actionlib.SimpleActionClient("ingress", IngressAction)
        assert cls.client.wait_for_server(rospy.Duration(support.DEADLINE_S))

    def setUp(self):
        self.plant.resume_odometry()
        call("abort")
        call("reset")
        enable(True)
        under_way = (GoalStatus.PENDING, GoalStatus.ACTIVE, GoalStatus.PREEMPTING, GoalStatus.RECALLING)
        support.wait_for(lambda: self.client.get_state() not in under_way, "the end of the goal before")
        self.plant.restart()
        self.feedback = []
        self.begin = time.monotonic() + 0.1  # states and positions of the previous test do not count
        self.wait_for_state("IDLE")

    def wait_for_state(self, *names):
        begin = max(self.begin, time.monotonic() - 0.3)
        return self.states.wait(lambda s: s.state_name in names, f"state {names}", begin=begin)

    def send(self, **goal):
        """Sends a goal until it is accepted: the first images and odometry may be under way."""
        def taken():
            self.client.send_goal(IngressGoal(**goal), feedback_cb=lambda feedback: self.feedback.append(feedback.state))
            support.wait_for(lambda: self.client.get_state() != GoalStatus.PENDING, "an answer to the goal")
            return self.client.get_state() == GoalStatus.ACTIVE
        support.wait_for(taken, "a goal that is accepted")

    def result(self):
        """Does not use wait_for_result: the client misses an answer that precedes the return of its send_goal."""
        support.wait_for(lambda: self.comm_state() == CommState.DONE, "the result")
        return self.client.get_result()

    def comm_state(self):
        return self.client.gh.get_comm_state()

    def refusal(self, **goal):
        self.client.send_goal(IngressGoal(**goal))
        result = self.result()
        self.assertEqual((self.client.get_state(), result.outcome), (GoalStatus.REJECTED, IngressResult.REFUSED), result.reason)
        return result.reason

    def cancel(self):
        """A zero is sent before the result, and only zeros after it."""
        begin = time.monotonic()
        self.client.cancel_goal()
        self.assertEqual((self.result().outcome, self.result().reason), (IngressResult.PREEMPTED, "the goal was cancelled"))
        self.assertEqual(self.client.get_state(), GoalStatus.PREEMPTED)
        said = self.results.wait(what="the result", begin=begin).header.stamp
        self.setpoints.wait(lambda s: s.header.stamp > said, "setpoints after the result", begin=begin)
        before = [s for s in self.setpoints.since(begin - 1.0) if s.header.stamp <= said]
        self.assertTrue(support.is_zero(before[-1]), before[-1])
        self.assertTrue(all(support.is_zero(s) for s in self.setpoints.since(begin) if s.header.stamp > said))
        self.states.wait(lambda s: s.state_name == "ABORTED" and s.reason == "the goal was cancelled", "the end, with its cause", begin=begin)

    def fly_to(self, state, **goal):
        self.send(**{**GLASS_FREE, **goal})
        self.plant.shows_window = True
        self.wait_for_state(state)

    def test_flies_through_and_says_so(self):
        self.fly_to("COMMIT", window_width=1.2, window_height=1.0, unverified_opening=IngressGoal.DENY)
        result = self.result()
        self.assertEqual((self.client.get_state(), result.outcome), (GoalStatus.SUCCEEDED, IngressResult.PASSED), result.reason)
        self.assertNotEqual(result.reason, "")
        names = [state.state_name for state in self.feedback]
        self.assertEqual(list(dict.fromkeys(names)), ["SEARCH", "ALIGN", "APPROACH", "COMMIT"])
        near = [state for state in self.feedback if state.target_valid]
        self.assertTrue(near and near[0].distance > near[-1].distance)
        self.assertTrue(any(0.0 < state.predicted_miss < 1.0 for state in near))
        self.assertTrue(all(state.reason for state in self.feedback))

    def reach(self, state):
        """Flies until the navigator is in this state, and moves if the state moves."""
        self.plant.sign_trusted = state != "ALIGN"
        if state in ("SEARCH", "HOLD"):
            self.send()
            self.setpoints.wait(lambda s: not support.is_zero(s), "motion")
        else:
            self.fly_to("APPROACH" if state == "BACK_OFF" else state)
        if state == "HOLD":
            self.plant.pause_odometry()
        if state == "APPROACH":
            self.setpoints.wait(lambda s: s.twist.linear.x > 0.2, "motion towards the window")
        if state == "BACK_OFF":
            support.wait_for(lambda: self.plant.place[0] > 1.5, "a way towards the window")
            self.plant.shows_window = False
            self.setpoints.wait(lambda s: s.twist.linear.x < -0.05, "motion away from the window", begin=time.monotonic())
        self.wait_for_state(state)

    def test_cancelled_in_search(self):
        self.reach("SEARCH")
        self.cancel()

    def test_cancelled_in_align(self):
        self.reach("ALIGN")
        self.cancel()

    def test_cancelled_in_approach(self):
        self.reach("APPROACH")
        self.cancel()

    def test_cancelled_in_commit(self):
        self.reach("COMMIT")
        self.cancel()

    def test_cancelled_in_hold(self):
        self.reach("HOLD")
        self.cancel()

    def test_cancelled_in_back_off(self):
        self.reach("BACK_OFF")
        self.cancel()

    def test_abort_stops_at_once_in_every_state(self):
        for state in ("SEARCH", "ALIGN", "APPROACH", "COMMIT", "HOLD", "BACK_OFF"):
            with self.subTest(state):
                self.reach(state)
                self.assertTrue(call("abort").success)
                answered = time.monotonic() + 0.1  # messages sent before may still be under way
                self.assertEqual((self.result().outcome, self.result().reason), (IngressResult.ABORTED, "aborted by the operator"))
                self.states.wait(lambda s: s.state_name == "ABORTED" and s.reason == "aborted by the operator", "the end", begin=answered)
                self.setpoints.wait(lambda s: True, "setpoints after the answer", begin=answered + 0.2)
                self.assertTrue(all(support.is_zero(s) for s in self.setpoints.since(answered)))
            self.setUp()

    def test_refused_with_every_reason_as_the_service_is(self):
        self.plant.pause_odometry()
        service = support.wait_for(lambda: self.service_refuses(), "a start that is refused")
        self.assertIn("odom", service)
        self.assertIn("odom", self.refusal())
        self.plant.resume_odometry()
        self.send()
        self.cancel()
        self.assertIn("reset first", self.refusal())

    @staticmethod
    def service_refuses():
        reply = call("start")
        if not reply.success:
            return reply.message
        call("abort")
        call("reset")
        return None

    def test_another_size_than_the_pose_nodes_is_refused(self):
        reason = self.refusal(window_width=1.6, window_height=1.4)
        self.assertIn("the goal's window is 1.60 x 1.40 m, the pose node uses 1.20 x 1.00 m", reason)
        self.assertIn("1.20 x 1.60", self.refusal(window_width=1.2, window_height=1.6))
        self.assertIn("nan", self.refusal(window_width=float("nan")))

    def test_what_no_goal_may_say_is_refused(self):
        self.assertIn("unverified_opening", self.refusal(unverified_opening=4))
        self.assertIn("glass", self.refusal(glass=3))

    def test_the_policy_is_that_of_the_goal(self):
        self.send(unverified_opening=IngressGoal.DENY, glass=IngressGoal.GLASS_EXCLUDED)
        self.assertIn("assumes that there is no glass (commit/glass); turns back", self.client.get_goal_status_text())

    def test_a_window_is_chosen_by_its_number(self):
        self.assertIn("window 7 is not known (topic facade); known: 1, 2", self.refusal(window_id=7))
        self.send(window_id=2)
        self.plant.shows_window = True
        self.states.wait(lambda s: s.window_id == 2, "window 2 as the target")
        self.cancel()

    def test_a_choice_that_is_not_taken_is_refused(self):
        self.plant.obeys_choice = False
        self.assertIn("the pose node has not accepted the window as target", self.refusal(window_id=2))

    def test_a_choice_that_waits_can_be_cancelled(self):
        self.plant.obeys_choice = False
        self.client.send_goal(IngressGoal(window_id=2))
        support.wait_for(lambda: self.comm_state() == CommState.PENDING, "a goal that waits")
        self.client.cancel_goal()
        result = self.result()
        self.assertEqual((result.outcome, result.reason), (IngressResult.PREEMPTED, "cancelled before the start"))
        self.assertEqual(self.states.wait(what="a state").state_name, "IDLE")

    def test_a_second_goal_is_refused_and_the_first_goes_on(self):
        self.send()
        second = actionlib.SimpleActionClient("ingress", IngressAction)
        self.assertTrue(second.wait_for_server(rospy.Duration(support.DEADLINE_S)))
        second.send_goal(IngressGoal())
        support.wait_for(lambda: second.gh.get_comm_state() == CommState.DONE, "the refusal")
        self.assertIn("another goal is under way", second.get_result().reason)
        self.assertEqual(self.client.get_state(), GoalStatus.ACTIVE)

    def test_a_mission_of_the_service_is_not_taken_over(self):
        support.wait_for(lambda: call("start").success, "a mission that starts")
        self.assertIn("already flying: SEARCH", self.refusal())
        self.assertEqual(self.states.wait(what="a state").state_name, "SEARCH")

    def test_the_abort_of_others_ends_the_goal(self):
        self.send()
        call("abort")
        result = self.result()
        self.assertEqual((self.client.get_state(), result.outcome), (GoalStatus.ABORTED, IngressResult.ABORTED))
        self.assertIn("aborted by the operator", result.reason)

    def test_an_abort_and_reset_before_its_first_step_end_the_goal(self):
        for _ in range(5):
            self.send()
            call("abort")
            call("reset")
            result = self.result()
            self.assertEqual(result.outcome, IngressResult.ABORTED, result.reason)

    def test_disabled_it_sends_nothing_and_starts_nothing(self):
        self.send()
        self.setpoints.wait(lambda s: not support.is_zero(s), "motion")
        self.assertIn("aborted, disabled: starts nothing and sends nothing; the guard sends zeros", enable(False).message)
        begin = time.monotonic() + 0.1
        self.assertEqual(self.result().outcome, IngressResult.ABORTED)
        self.setpoints.wait(support.is_zero, "zero after the abort")
        self.assertTrue(all(support.is_zero(s) for s in self.setpoints.since(begin)))
        call("reset")
        self.states.wait(lambda s: s.state_name == "IDLE" and s.reason == "disabled (~enable)" and not s.enabled, "IDLE, disabled")
        begin = time.monotonic() + 0.1
        support.wait_for(lambda: time.monotonic() > begin, "setpoints of before")
        self.assertIn("nothing to abort", call("abort").message)
        support.wait_for(lambda: time.monotonic() > begin + 1.0, "the time of the measurement")
        self.assertEqual(self.setpoints.since(begin), [])
        self.assertIn("disabled (~enable)", self.refusal())
        self.assertIn("disabled (~enable)", call("start").message)
        self.assertTrue(enable(True).success)
        self.setpoints.wait(support.is_zero, "zeros in IDLE")

    def test_disabled_behind_the_window_it_gives_up_its_place(self):
        self.fly_to("PASSED")
        enable(False)
        others = rospy.Publisher("cmd_vel", TwistStamped, queue_size=1)
        begin = time.monotonic()
        while time.monotonic() < begin + 2.0:  # less than hold/leash_m
            others.publish(TwistStamped(header=Header(stamp=rospy.Time.now()), twist=Twist(linear=Vector3(x=0.4))))
            rospy.rostime.wallsleep(0.05)
        enable(True)
        begin = time.monotonic()
        support.wait_for(lambda: time.monotonic() > begin + 1.0, "the time of the measurement")
        self.assertTrue(all(support.is_zero(s) for s in self.setpoints.since(begin)))

    def test_disabled_before_its_first_step_it_does_not_fly(self):
        for _ in range(5):
            support.wait_for(lambda: call("start").success, "a mission that starts")
            begin = time.monotonic()
            self.assertIn("aborted, ", enable(False).message)
            self.states.wait(lambda s: s.state_name == "ABORTED", "the end of the mission", begin=begin)
            call("reset")
            enable(True)

    def documented_client(self, before=""):
        page = pathlib.Path(rospkg.RosPack().get_path("window_ingress")) / "doc/ros_api.md"
        if not page.is_file():
            self.skipTest("documents are not installed")
        program = re.search(r"^```python\n(.*?)^```", page.read_text(encoding="utf-8"), flags=re.M | re.S)[1]
        self.assertLessEqual(program.count("\n"), 20)
        return subprocess.Popen([sys.executable, "-c", before + program], stdout=subprocess.PIPE, text=True)

    def test_the_documented_client_hears_a_refusal_that_comes_at_once(self):
        enable(False)
        client = self.documented_client(before=ANSWERED_FIRST)
        said, _ = client.communicate(timeout=30.0)
        self.assertEqual(client.returncode, 1, said)
        self.assertIn("disabled (~enable)", said)

    def test_the_documented_client_flies(self):
        client = self.documented_client()
        self.wait_for_state("SEARCH")
        self.plant.shows_window = True
        said, _ = client.communicate(timeout=60.0)
        self.assertEqual(client.returncode, 0, said)
        self.assertIn("PASSED", said)

    def test_the_documented_client_aborts_when_it_is_stopped(self):
        client = self.documented_client()
        self.wait_for_state("SEARCH")
        client.send_signal(signal.SIGINT)
        self.wait_for_state("ABORTED")
        said, _ = client.communicate(timeout=20.0)
        self.assertIn("the goal was cancelled", said)  # it has not ended before its message was heard

    def test_a_client_that_is_killed_changes_nothing(self):
        client = self.documented_client()
        self.wait_for_state("SEARCH")
        os.kill(client.pid, signal.SIGKILL)
        client.communicate(timeout=20.0)
        begin = time.monotonic() + 0.5
        self.states.wait(lambda s: s.state_name == "SEARCH" and s.enabled, "the search to go on", begin=begin)
        self.setpoints.wait(lambda s: not support.is_zero(s), "motion")
        self.plant.pause_odometry()
        begin = time.monotonic() + STALE_WITHIN_S
        self.wait_for_state("HOLD", "ABORTED")
        support.wait_for(lambda: len(self.setpoints.since(begin)) > 10, "the stream after the loss")
        self.assertTrue(all(support.is_zero(s) for s in self.setpoints.since(begin)))


if __name__ == "__main__":
    rospy.init_node("mission_action_test")
    rostest.rosrun("window_ingress", "mission_action_test", MissionActionTest, sys.argv)
