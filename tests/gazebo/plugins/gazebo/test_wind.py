"""Wind against the solution of m dv/dt = m k (w − v)."""

import math
from pathlib import Path

import pytest

import trundle
from trundle.gazebo.model_plugins import load_plugins, load_world_plugins
from trundle.sim.simulation import Simulation

BODY = "<inertial><mass>{}</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>"
NO_LAG = """<horizontal><magnitude><time_for_rise>0</time_for_rise>{}</magnitude><direction>
<time_for_rise>0</time_for_rise></direction></horizontal><vertical><time_for_rise>0</time_for_rise></vertical>"""


def load_wind(folder: Path, plugin: str, *, wind: str = "6 8 1", filename: str = "libWindPlugin.so") -> Simulation:
    """Return a world with light, heavy and nested bodies with <enable_wind>, and bodies without."""
    file = folder / "w.sdf"
    windy = "<enable_wind>1</enable_wind>"
    file.write_text(
        f'<sdf version="1.6"><world name="w"><gravity>0 0 0</gravity><wind><linear_velocity>{wind}</linear_velocity>'
        f'</wind><model name="light">{windy}<link name="l">{BODY.format(2)}</link></model>'
        f'<model name="heavy"><link name="l">{windy}{BODY.format(50)}</link></model>'
        f'<model name="calm"><link name="l">{BODY.format(1)}</link></model>'
        f'<model name="outer"><link name="l">{BODY.format(1)}</link><model name="inner">{windy}<link name="l">'
        f"{BODY.format(1)}</link></model></model>"
        f'<plugin name="p" filename="{filename}">{plugin}</plugin></world></sdf>'
    )
    sim = trundle.load(str(file))
    load_plugins(sim, None, {}, log=lambda _: None)
    load_world_plugins(sim, None, {}, log=lambda _: None)
    return sim


def velocity(sim: Simulation, model: str, link: str = "l") -> tuple[float, float, float]:
    return sim[model].link(link).twist.linear


def test_a_body_of_any_mass_approaches_the_wind_speed(tmp_path: Path) -> None:
    factor = "<force_approximation_scaling_factor>0.5</force_approximation_scaling_factor>"
    sim = load_wind(tmp_path, factor + NO_LAG.format(""))
    sim.run(2.0)

    expected = [w * (1 - math.exp(-0.5 * 2.0)) for w in (6, 8, 1)]
    for model, link in (("light", "l"), ("heavy", "l"), ("outer", "inner::l")):
        assert velocity(sim, model, link) == pytest.approx(expected, rel=1e-3)
    assert velocity(sim, "calm") == velocity(sim, "outer") == (0.0, 0.0, 0.0)
    assert not sim.report.warnings


def test_wind_rises_with_a_lag_also_after_a_reset(tmp_path: Path) -> None:
    """With a lag of 2 s and k = 0.5/s both poles are equal: v = w (1 − (1 + k t) e^(−k t))."""
    rise = "<time_for_rise>2</time_for_rise>"
    sim = load_wind(
        tmp_path,
        "<force_approximation_scaling_factor>0.5</force_approximation_scaling_factor>"
        f"<horizontal><magnitude>{rise}</magnitude></horizontal><vertical>{rise}</vertical>",
        wind="10 0 4",
    )
    for _ in range(2):
        sim.run(3.0)
        ratio = 1 - (1 + 0.5 * 3.0) * math.exp(-0.5 * 3.0)
        assert velocity(sim, "light") == pytest.approx((10 * ratio, 0, 4 * ratio), rel=2e-3)
        sim.reset()


def test_a_sine_varies_the_wind_about_its_mean(tmp_path: Path) -> None:
    """A light body follows a strong force at once: the amplitude of 20 % after a quarter of the period."""
    swing = "<sin><amplitude_percent>0.2</amplitude_percent><period>40</period></sin>"
    factor = "<force_approximation_scaling_factor>100</force_approximation_scaling_factor>"
    sim = load_wind(tmp_path, factor + NO_LAG.format(swing), wind="10 0 0")
    sim.run(10.0)

    assert velocity(sim, "light")[0] == pytest.approx(12.0, rel=1e-3)


def test_wind_noise_repeats_for_the_same_seed(tmp_path: Path) -> None:
    noise = '<noise type="gaussian"><mean>0</mean><stddev>3</stddev></noise>'
    factor = "<force_approximation_scaling_factor>1</force_approximation_scaling_factor>"
    runs = [load_wind(tmp_path, factor + NO_LAG.format(noise_tag)) for noise_tag in (noise, noise, "")]
    for sim in runs:
        sim.run(0.1)

    first, second, calm = (velocity(sim, "light") for sim in runs)
    assert first == second != calm


def test_wind_without_a_scaling_factor_is_reported(tmp_path: Path) -> None:
    sim = load_wind(tmp_path, "")
    sim.run(0.1)

    assert velocity(sim, "light") == (0.0, 0.0, 0.0)
    (warning,) = sim.report.warnings
    assert warning.endswith("needs a <force_approximation_scaling_factor> above 0; there is no wind force")


def test_wind_without_its_plugin_and_misplaced_plugins_are_reported(tmp_path: Path) -> None:
    sim = load_wind(tmp_path, "", filename="libBuoyancyPlugin.so")

    (warning,) = sim.report.warnings
    assert warning.endswith(
        "plugin 'p' (libBuoyancyPlugin.so) is a model's; it belongs into a <model>; the run goes on without it"
    )
    assert any("it needs libWindPlugin.so" in finding.what for finding in sim.report.findings)
