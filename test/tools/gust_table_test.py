"""tools/gust_table: one campaign for each wind, with and without the observer; a table and a picture."""
import yaml

from repository import rows_of, run


def test_flies_each_wind_with_and_without_the_observer(tmp_path):
    done = run("gust_table", "--output", tmp_path, "--speeds", 0, 3, "--seeds", "1..3")
    assert done.returncode == 0, done.stderr
    for name in ("observer_on_0", "observer_on_3", "observer_off_0", "observer_off_3"):
        assert len(rows_of(tmp_path / name / "flights.csv")) == 3
    wind = yaml.safe_load((tmp_path / "observer_on_3/scenario.yaml").read_text())["wind"]
    assert wind["gusts"] == "dryden" and wind["wind_20ft_mps"] == 3
    off = yaml.safe_load((tmp_path / "observer_off_3/params.yaml").read_text())
    assert off["ingress_navigator"]["navigator"]["approach"]["max_wind_mps"] == 0
    assert "observer on" in (tmp_path / "gusts.md").read_text()
    assert (tmp_path / "gusts.png").stat().st_size > 10000


def test_wind_matters(tmp_path):
    """The same seeds in still air and in a storm give other offsets: the wind reaches the vehicle."""
    assert run("gust_table", "--output", tmp_path, "--speeds", 0, 6, "--seeds", "1..2").returncode == 0
    still, storm = ((tmp_path / f"observer_on_{v}/flights.csv").read_text() for v in (0, 6))
    assert still != storm


def test_wrong_usage_says_what_to_do(tmp_path):
    for arguments, text in [(["--scenario", tmp_path / "none.yaml"], "no such file"), (["--speeds", -1], "from 0 to 15"),
                            (["--seeds", "many"], "give A..B")]:
        done = run("gust_table", "--output", tmp_path / "out", *arguments)
        assert done.returncode == 2
        assert text in done.stderr
