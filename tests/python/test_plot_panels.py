# SPDX-License-Identifier: MIT
"""Pictures say what the log says: lines, marks, axes, the level behind."""

import numpy as np
import pytest
from logs import CHANNELS, messages, state_message, walk, write

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("agg")

from matplotlib.collections import LineCollection  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402

import tahr  # noqa: E402
from tahr.plot import above, height, modes, overview, queries, side, speed  # noqa: E402
from tahr.plot import _relief, _scene, _style, panels  # noqa: E402
from tahr.plot._paths import leaps, polylines, seconds  # noqa: E402
from tahr.telemetry import read_log  # noqa: E402

FLOOR = (np.array([[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0.0]]), np.array([[0, 1, 2], [0, 2, 3]]))


@pytest.fixture(scope="module")
def log(tmp_path_factory):
    return read_log(write(tmp_path_factory.mktemp("plot") / "walk.lcmlog", walk()))


@pytest.fixture
def ax():
    return Figure().subplots()


def lines_of(ax, colour):
    found = [c for c in ax.collections if isinstance(c, LineCollection)]
    same = [c for c in found if matplotlib.colors.same_color(c.get_colors()[0][:3], colour)]
    return [segment for collection in same for segment in collection.get_segments()]


def marks_of(ax, label):
    mark = next(mark for mark in _style.MARKS if mark.label == label)
    same = [line for line in ax.lines if line.get_marker() == mark.shape and line.get_markerfacecolor() == mark.colour]
    return np.concatenate([line.get_xydata() for line in same]) if same else np.empty((0, 2))


COLOURS = {mode.name: mode.colour for mode in _style.modes_of(np.arange(7))}


def test_the_ways_from_above_are_those_of_the_log_by_mode(log, ax):
    above(ax, log)
    for name, number in (("walking", tahr.MODE_WALKING), ("falling", tahr.MODE_FALLING)):
        states = log.states[log.states["mode"] == number]
        drawn = np.concatenate(lines_of(ax, COLOURS[name]))
        for place in states["position"][:: len(states) // 20, :2]:
            assert np.min(np.linalg.norm(drawn - place, axis=1)) < 0.1
    assert ax.get_xlabel() == "x in m" and ax.get_ylabel() == "y in m"


def test_every_character_begins_at_a_dot_with_its_number(log, ax):
    above(ax, log)
    assert sorted(text.get_text() for text in ax.texts) == ["0", "1", "2"]
    for text in ax.texts:
        first = log.of(int(text.get_text())).states["position"][0, :2]
        assert np.allclose(text.xy, first)


def test_marks_are_at_the_events(log, ax):
    height(ax, log)
    landed = log.events[log.events["type"] == tahr.EVENT_LANDED]
    marks = marks_of(ax, "landing")
    assert np.allclose(np.sort(marks[:, 0]), np.sort(seconds(landed)))
    assert np.abs(marks[:, 1]).max() < 0.1  # the feet are on the floor then
    assert ax.get_xlabel() == "simulated time in s" and "in m" in ax.get_ylabel()


def test_heights_are_those_of_the_feet(log, ax):
    height(ax, log, characters=1)
    drawn = np.concatenate([*lines_of(ax, COLOURS["walking"]), *lines_of(ax, COLOURS["falling"])])
    own = log.of(1).states
    highest = (own["position"][:, 2] - own["half_height"]).max()
    assert drawn[:, 1].max() == pytest.approx(highest, abs=0.01)
    assert highest > 0.9


def test_speeds_are_those_of_the_log(log, ax):
    speed(ax, log, characters=[0])
    own = log.of(0).states
    drawn = np.concatenate([*lines_of(ax, COLOURS["walking"]), *lines_of(ax, COLOURS["falling"])])
    expected = np.interp(drawn[:, 0], seconds(own), np.linalg.norm(own["velocity"], axis=1))
    assert np.allclose(drawn[:, 1], expected, atol=1e-9)
    assert ax.get_ylabel() == "speed in m/s"


def test_speeds_of_many_are_a_spread(tmp_path, ax):
    log = read_log(write(tmp_path / "many.lcmlog", walk(characters=8, steps=60)))
    speed(ax, log)
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    assert labels == ["all", "8 of 10", "median"]
    line = ax.lines[0].get_xydata()
    at = np.argmin(np.abs(line[:, 0] - 0.5))
    step = log.states["step"] == round(line[at, 0] * 60 - 0.5)
    speeds = np.sort(np.linalg.norm(log.states["velocity"][step], axis=1))
    assert speeds[3] <= line[at, 1] <= speeds[4]


def test_the_timeline_has_a_row_for_each_character(log, ax):
    modes(ax, log)
    assert [label.get_text() for label in ax.get_yticklabels()] == ["0", "1", "2"]
    bars = [box for collection in ax.collections for box in collection.get_paths()]
    falling = [
        box
        for c in ax.collections
        for box, face in zip(c.get_paths(), c.get_facecolors())
        if matplotlib.colors.same_color(face[:3], COLOURS["falling"])
    ]
    length = sum(np.ptp(box.vertices[:, 0]) for box in falling)
    share = np.sum(log.states["mode"] == tahr.MODE_FALLING) / len(log.states)
    assert length / sum(np.ptp(box.vertices[:, 0]) for box in bars) == pytest.approx(share, abs=0.03)


def test_the_timeline_of_many_counts_them(tmp_path, ax):
    log = read_log(write(tmp_path / "many.lcmlog", walk(characters=41, steps=30)))
    modes(ax, log)
    assert ax.get_ylabel() == "characters in %"
    tops = [np.max([path.vertices[:, 1].max() for path in c.get_paths()]) for c in ax.collections]
    assert max(tops) == pytest.approx(100)


def test_queries_are_means_over_the_characters_and_the_most(log, ax):
    queries(ax, log)
    reports = log.reports
    total = reports["sweeps"] + reports["contact_queries"] + reports["rays"] + reports["fluid_queries"]
    most = ax.lines[0].get_ydata()
    assert most.max() == total.max()
    assert most[30] == total[reports["step"] == 30].max()
    stacked = sum(area(path.vertices) for c in ax.collections for path in c.get_paths() if len(path.vertices) > 3)
    assert stacked == pytest.approx(total.mean() * seconds(reports).max(), rel=1e-3)


def area(polygon):
    x, y = polygon.T
    return abs(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)) / 2


def test_legends_name_modes_and_marks_with_their_counts(log, ax):
    labels = panels.legend_entries(ax, log)[1]
    landed = np.sum(log.events["type"] == tahr.EVENT_LANDED)
    assert "walking" in labels and "falling" in labels and "swimming" not in labels
    assert f"landing ({landed})" in labels and "jump (3)" in labels


def test_colours_of_modes_stay_apart_for_the_colour_blind():
    """Machado's matrices for the complete lack of one cone, on linear light."""
    kinds = [np.eye(3)]
    kinds.append(np.array([[0.152, 1.053, -0.205], [0.115, 0.786, 0.099], [-0.004, -0.048, 1.052]]))
    kinds.append(np.array([[0.367, 0.861, -0.228], [0.280, 0.673, 0.047], [-0.012, 0.043, 0.969]]))
    names = ["walking", "falling", "swimming", "flying", "hanging"]
    colours = np.array([matplotlib.colors.to_rgb(COLOURS[name]) for name in names]) ** 2.2
    for kind in kinds:
        seen = np.clip(colours @ kind.T, 0, 1) ** (1 / 2.2)
        for i, a in enumerate(seen):
            for j, b in enumerate(seen[:i]):
                assert np.linalg.norm(a - b) > 0.1, (names[i], names[j])
    assert next(mode for mode in _style.modes_of(np.arange(7)) if mode.name == "falling").dashes != "solid"


def test_lines_are_cut_where_somebody_was_put_elsewhere(log):
    own = log.of(0).states.copy()
    own["position"][50:] += (100, 0, 0)
    assert np.flatnonzero(leaps(own)).tolist() == [49]
    for lines in polylines(own, own["position"][:, :2], (10.0, 10.0)).values():
        for line in lines:
            assert np.linalg.norm(np.diff(line, axis=0), axis=1).max(initial=0) < 50


def test_thinned_lines_are_where_all_points_are(log):
    own = log.of(2).states
    points = own["position"][:, :2]
    lines = [line for found in polylines(own, points, (10.0, 10.0)).values() for line in found]
    drawn = np.concatenate(lines)
    assert len(drawn) < 2 * len(points)
    for point in points:
        assert np.min(np.linalg.norm(drawn - point, axis=1)) <= np.hypot(10, 10) / 2500


def test_a_log_without_states_says_so(tmp_path):
    log = read_log(write(tmp_path / "none.lcmlog", [(CHANNELS["event"], messages.event_t())]))
    for panel in (above, side, height, speed, modes):
        ax = Figure().subplots()
        panel(ax, log)
        assert "no states in this log" in [text.get_text() for text in ax.texts]
    overview(log)


def test_a_part_of_a_log_is_drawn_over_its_own_time(log):
    figure = overview(log.between(0.5, 1.0))
    assert figure.texts[0].get_text() == "flat: 3 characters from 0.5 to 1 s on native"
    for ax in figure.subfigs[1].axes:
        assert ax.get_xlim() == pytest.approx((0.5, 1.0))


def test_a_character_that_is_not_there_is_refused(log, ax):
    for panel in (above, side, height, speed, modes, queries):
        with pytest.raises(ValueError, match="no message of character 9; there are 0-2"):
            panel(ax, log, characters=9)
    with pytest.raises(ValueError, match="expected vertices of shape"):
        above(ax, log, (np.zeros((3, 2)), np.zeros((1, 3), int)))


def test_a_flat_world_is_seen_from_its_side(tmp_path):
    config = tahr.Config("platformer")
    told = []
    for step in range(30):
        state = tahr.State(config, position=(step / 10, 2 + step / 100, 0))
        told.append((CHANNELS["state"], state_message(0, step, state)))
    log = read_log(write(tmp_path / "flat.lcmlog", told))
    assert _scene.is_flat(log.states)
    figure = overview(log)
    assert "from its side" in figure.texts[1].get_text()
    axes = [a for part in figure.subfigs for a in part.axes]
    assert [a.get_ylabel().replace("\n", " ") for a in axes] == [
        "y in m", "height of the feet in m", "speed in m/s", "character", "queries per step",
    ]  # fmt: skip
    ax = Figure().subplots()
    height(ax, log)
    drawn = np.concatenate(lines_of(ax, COLOURS["falling"]))
    assert drawn[-1, 1] == pytest.approx(log.states["position"][-1, 1] - log.states["half_height"][-1])


def relief(vertices, triangles, view=_relief.ABOVE, scale=10.0):
    corners = np.asarray(vertices, float)[np.asarray(triangles)]
    return _relief.draw(corners, view, _relief.Frame(0, 4, 0, 4, scale), 0.64)


def test_the_relief_shows_ground_steep_ground_walls_and_nothing():
    ground = [[0, 0, 0], [2, 0, 0], [2, 4, 0], [0, 4, 0]]
    slope = [[2, 0, 0], [3, 0, 2], [3, 4, 2], [2, 4, 0]]
    wall = [[1, 1, 0], [1, 3, 0], [1, 3, 2]]
    image = relief(ground + slope + wall, [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7], [8, 9, 10]])
    assert image.shape == (40, 40, 4)
    assert image[20, 35, 3] == 0 and image[20, 5, 3] == 255
    flat, steep = image[5, 5, :3].astype(int), image[5, 25, :3].astype(int)
    assert steep.max() < flat.min()
    assert image[20, 10, :3].tolist() == [58, 66, 82] and image[35, 10, :3].tolist() != [58, 66, 82]


def test_the_relief_shows_the_nearest_of_two_floors_and_the_edge_of_a_drop():
    low = [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]]
    high = [[0, 0, 1], [2, 0, 1], [2, 4, 1], [0, 4, 1]]
    image = relief(high + low, [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]])
    assert image[20, 5].tolist() != image[20, 35].tolist()
    assert image[20, 19, :3].max() < image[20, 10, :3].min()
    same = relief(low + high, [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]])
    assert np.array_equal(image, same)


TWO_FLOORS = [[0, 0, 0], [2, 0, 0], [2, 4, 0], [0, 4, 0], [2, 0, 2], [4, 0, 2], [4, 4, 2], [2, 4, 2]]
UP = [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]]


def test_ceilings_do_not_hide_floors():
    ceiling = [[0, 0, 3], [4, 0, 3], [4, 4, 3], [0, 4, 3]]
    room = relief(TWO_FLOORS + ceiling, [*UP, [10, 9, 8], [11, 10, 8]])
    assert np.array_equal(room, relief(TWO_FLOORS, UP))


def test_faces_that_look_away_are_ground_where_nothing_else_is():
    down = [triangle[::-1] for triangle in UP]
    assert np.array_equal(relief(TWO_FLOORS, down), relief(TWO_FLOORS, UP))


def test_from_the_south_only_what_is_beside_the_ways_is_seen(log):
    def wall(y):
        return [[-9, y, 0], [9, y, 0], [9, y, 3]]

    middle = log.states["position"][:, 1].mean()
    walls = np.array([wall(-30), wall(middle), wall(30)], float)
    assert np.array_equal(_scene._beside(walls, log.states), walls[1:2])
    behind = _scene.level_behind(walls[1:2], _relief.SOUTH, log.states)
    assert (behind.image[..., 3] == 255).mean() > 0.3
    away = _scene.level_behind(walls[1:2, ::-1], _relief.SOUTH, log.states)
    assert (away.image[..., 3] == 255).mean() < 0.1


def test_the_level_lies_where_it_is(log, ax):
    above(ax, log, FLOOR)
    left, right, bottom, top = ax.images[0].get_extent()
    scale = 1 / ((right - left) / ax.images[0].get_array().shape[1])
    image = ax.images[0].get_array()
    row, column = int((top - 0) * scale), int((0 - left) * scale)
    assert image[row, column, 3] == 255
    edge = image[row, :, 3].astype(int)
    begin = left + np.flatnonzero(edge)[0] / scale
    assert begin == pytest.approx(-9, abs=2 / scale)


@pytest.mark.parametrize("kind", ["png", "svg", "pdf"])
def test_an_overview_can_be_written(log, tmp_path, kind):
    path = tmp_path / f"overview.{kind}"
    figure = overview(log, FLOOR, up="z")
    figure.savefig(path, dpi=40)
    assert path.stat().st_size > 5000
    assert figure.texts[0].get_text() == "flat: 3 characters for 1.5 s on native"
    axes = [a for part in figure.subfigs for a in part.axes]
    assert [a.get_ylabel().replace("\n", " ") for a in axes] == [
        "y in m", "z in m (stretched)", "height of the feet in m", "speed in m/s", "character", "queries per step",
    ]  # fmt: skip
