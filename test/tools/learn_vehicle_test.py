"""learn_vehicle makes the parameter file of the next flight from a recorded one."""
import pytest
import yaml

from repository import run

rosbag = pytest.importorskip("rosbag")
IngressState = pytest.importorskip("window_ingress.msg").IngressState
rospy = pytest.importorskip("rospy")


def bag_of(folder, states, topics=("/state",)):
    file = folder / "flight.bag"
    with rosbag.Bag(str(file), "w") as bag:
        for i, fields in enumerate(states):
            for topic in topics:
                bag.write(topic, IngressState(**fields), rospy.Time(10 + i))
    return file


def learn(bag, output, *options):
    return run("learn_vehicle", bag, "--output", output, *options)


def test_the_last_measurement_is_written(tmp_path):
    bag = bag_of(tmp_path, [dict(response=0.3), dict(response_measured=True, response=0.64),
                            dict(response_measured=True, response=0.46, acceleration_limit=1.0), dict(response=0.3)])
    done = learn(bag, tmp_path / "mine.yaml")
    assert done.returncode == 0, done.stderr
    assert yaml.safe_load((tmp_path / "mine.yaml").read_text()) == {"vehicle": {"response_sec": 0.46, "braking_mps2": 1.0}}


def test_without_a_limit_braking_stays_as_it_is(tmp_path):
    bag = bag_of(tmp_path, [dict(response_measured=True, response=0.17)])
    assert learn(bag, tmp_path / "mine.yaml").returncode == 0
    assert yaml.safe_load((tmp_path / "mine.yaml").read_text()) == {"vehicle": {"response_sec": 0.17}}


@pytest.mark.parametrize("states, topics, options, code, says", [
    ([dict(response=0.3)], ("/state",), (), 1, "not asked to change its velocity"),
    ([dict(response_measured=True)], ("/a", "/b"), (), 2, "--state"),
    ([dict(response_measured=True)], ("/state",), ("--state", "/other"), 2, "no topic"),
])
def test_what_tells_nothing_is_refused(tmp_path, states, topics, options, code, says):
    done = learn(bag_of(tmp_path, states, topics), tmp_path / "mine.yaml", *options)
    assert done.returncode == code and says in done.stderr
    assert not (tmp_path / "mine.yaml").exists()


def test_no_bag_is_said_in_one_line(tmp_path):
    (tmp_path / "no.bag").write_text("nothing")
    done = learn(tmp_path / "no.bag", tmp_path / "mine.yaml")
    assert done.returncode == 2 and len(done.stderr.splitlines()) == 1
    done = learn(tmp_path / "none.bag", tmp_path / "mine.yaml")
    assert done.returncode == 2 and done.stderr == f"learn_vehicle: {tmp_path}/none.bag: No such file or directory\n"


def test_a_file_that_is_there_is_replaced_only_where_that_is_asked_for(tmp_path):
    bag = bag_of(tmp_path, [dict(response_measured=True, response=0.17)])
    (tmp_path / "mine.yaml").write_text("of another vehicle")
    done = learn(bag, tmp_path / "mine.yaml")
    assert done.returncode == 2 and "mine.yaml is there already: --overwrite" in done.stderr
    assert (tmp_path / "mine.yaml").read_text() == "of another vehicle"
    assert learn(bag, tmp_path / "mine.yaml", "--overwrite").returncode == 0
