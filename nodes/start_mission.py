#!/usr/bin/env python3
"""Starts the mission as soon as the navigator accepts, waits for the referee, prints how the flight ended.

If the scenario sets `target_chosen`, it first clicks on the target, as a user does in rviz.

Parameter ~wait_sec, default 0: wall time before it calls the navigator, so that you can watch the start.
Last line: [INGRESS] outcome=PASSED time_s=... offset_y_m=... offset_z_m=...; exit code 0 if PASSED, else 1.
"""
import sys
import threading
import time

import rospy
from geometry_msgs.msg import PointStamped, PoseStamped
from std_msgs.msg import Bool
from std_srvs.srv import Trigger
from window_ingress.msg import Facade, FlightVerdict

READY_WITHIN_S = 120.0   # wall time until the target must be chosen and the navigator must have accepted
FLIGHT_WITHIN_S = 900.0  # wall time until the referee must have decided
RETRY_S = 0.5


def start(deadline, over):
    """Calls the navigator until it accepts. In lockstep the mission starts by itself, and may be over by now."""
    rospy.wait_for_service("ingress_navigator/start", timeout=deadline - time.monotonic())
    service = rospy.ServiceProxy("ingress_navigator/start", Trigger)
    said = None
    while time.monotonic() < deadline and not rospy.is_shutdown():
        reply = service()
        if reply.success:
            return reply.message
        if reply.message != said:
            print(f"not ready: {reply.message}", file=sys.stderr)
        said = reply.message
        time.sleep(RETRY_S)  # wall time: /clock may not run yet
        if over.is_set():
            return "the mission is over"
    raise RuntimeError(f"the navigator did not start within {READY_WITHIN_S:.0f} s: {said}")


def choose_target(deadline):
    """Clicks on the window's true position until the pose node makes it the target."""
    window = rospy.wait_for_message("ground_truth/window", PoseStamped, deadline - time.monotonic())
    click = PointStamped(header=window.header, point=window.pose.position)
    chosen = threading.Event()
    rospy.Subscriber("facade", Facade, lambda facade: facade.target_chosen and chosen.set())
    clicks = rospy.Publisher("clicked_point", PointStamped, queue_size=1)
    while not chosen.wait(RETRY_S):  # wall time: /clock may not run yet
        if time.monotonic() >= deadline or rospy.is_shutdown():
            raise RuntimeError(f"the target was neither seen nor chosen within {READY_WITHIN_S:.0f} s")
        clicks.publish(click)


def main():
    rospy.init_node("start_mission", disable_signals=True)
    over, verdicts = threading.Event(), []

    def receive(verdict):
        if verdict.outcome != FlightVerdict.RUNNING:
            verdicts.append(verdict)
            over.set()

    rospy.Subscriber("referee", FlightVerdict, receive)
    time.sleep(rospy.get_param("~wait_sec", 0.0))  # wall time: /clock may not run yet
    deadline = time.monotonic() + READY_WITHIN_S
    if rospy.wait_for_message("scenario/target_chosen", Bool, READY_WITHIN_S).data:
        choose_target(deadline)
    print(start(deadline, over), file=sys.stderr)
    if not over.wait(FLIGHT_WITHIN_S):
        raise RuntimeError(f"no verdict within {FLIGHT_WITHIN_S:.0f} s")
    verdict = verdicts[0]
    print(verdict.reason, file=sys.stderr)
    print(f"[INGRESS] outcome={verdict.outcome_name} time_s={verdict.time:.2f} "
          f"offset_y_m={verdict.offset_y:.3f} offset_z_m={verdict.offset_z:.3f}", flush=True)
    return 0 if verdict.outcome == FlightVerdict.PASSED else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (KeyboardInterrupt, rospy.ROSException, rospy.ServiceException, RuntimeError) as error:
        print(f"start_mission: {error}", file=sys.stderr)
        sys.exit(1)
