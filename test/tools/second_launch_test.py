"""A second launch beside a running one: ROS would end the nodes of the first, including the guard of a flying vehicle."""
import contextlib
import os
import threading
import xmlrpc.server

import pytest

from repository import run


@contextlib.contextmanager
def master(running=(), died=()):
    """A stand-in for roscore and running nodes. Returns its port."""
    server = xmlrpc.server.SimpleXMLRPCServer(("localhost", 0), logRequests=False)
    uri = f"http://localhost:{server.server_address[1]}/"
    known = {**{node: uri for node in running}, **{node: "http://localhost:1/" for node in died}}
    server.register_function(lambda _, node: [1, "", known[node]] if node in known else [-1, "unknown node", ""], "lookupNode")
    server.register_function(lambda _: [1, "", os.getpid()], "getPid")
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield server.server_address[1]
    server.shutdown()
    server.server_close()


def launched(port, *arguments, by_option=False):
    """Output of roslaunch before it starts anything; a missing file ends it in any case."""
    option, uri = (["-p", port], "http://localhost:1") if by_option else ([], f"http://localhost:{port}")
    done = run("roslaunch", *option, *arguments, "config:=/nowhere.yaml", env={**os.environ, "ROS_MASTER_URI": uri})
    assert done.returncode == 1, done.stdout
    return done.stderr


@pytest.mark.parametrize("by_option", [False, True])
@pytest.mark.parametrize("name, node", [("ingress", "/setpoint_guard"), ("sim", "/ingress_navigator"), ("replay", "/window_detector")])
def test_it_is_refused_and_says_which_node_it_would_end(name, node, by_option):
    bag = ["bag:=/tmp/none.bag"] if name == "replay" else []
    with master(running=[node]) as port:
        said = launched(port, "window_ingress", f"{name}.launch", *bag, by_option=by_option)
    assert f"{node} runs already at http://localhost:{port}: this launch would end it" in said and "nothing is started" in said


def test_what_died_and_what_it_does_not_start_does_not_matter():
    with master(running=["/rviz"], died=["/setpoint_guard"]) as port:
        assert "/nowhere.yaml: no such file" in launched(port, "window_ingress", "ingress.launch")
    with master(running=["/setpoint_guard"]) as port:
        assert "/nowhere.yaml: no such file" in launched(port, "window_ingress", "replay.launch", "bag:=/tmp/none.bag")
