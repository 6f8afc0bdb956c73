# SPDX-License-Identifier: MIT
"""The charts of each family: which rows are drawn against which, and what is said about them."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from matplotlib.figure import Figure

from front import ERROR_FLOOR
from panel import MEDIAN_ERROR, P99_ERROR, Scale, dots, over_size, scatter
from rows import Row, budget_gains, thread_gains
from style import panels

NS_SWEEP = Scale(lambda r: r.ns_p50, "median time of a sweep", "s", 1e-9)
NS_STEP = Scale(lambda r: r.ns_p50, "median time of a step", "s", 1e-9)
NS_TICK = Scale(lambda r: r.ns_p50, "time per character and tick", "s", 1e-9)
NS_SECOND = Scale(lambda r: r.ns_per_second, "time per simulated second", "s", 1e-9)
TESTS = Scale(lambda r: r.tests_and_iterations, "narrow tests + iterations per sweep")
TESTS_STEP = Scale(lambda r: r.tests_and_iterations, "narrow tests + iterations per step")
QUERIES = Scale(lambda r: r.queries, "queries per step")
QUERIES_SECOND = Scale(lambda r: r.queries_per_second, "queries per simulated second")


@dataclass
class Chart:
    """One picture with its caption and the rows it shows."""

    name: str
    title: str
    caption: str
    figure: Figure
    rows: list[Row]


@dataclass(frozen=True)
class Topic:
    """Curves of whole movement that belong on one picture."""

    name: str
    title: str
    curves: tuple[str, ...]
    work: Scale
    count: Scale
    also: tuple[str, ...] = ()  # single settings of other curves, to compare with


TOPICS = (
    Topic(
        "rates",
        "how often it is stepped, 10 to 1000 Hz",
        ("precise", "platformer", "stepped", "two walls", "unreal"),
        NS_SECOND,
        QUERIES_SECOND,
    ),
    Topic(
        "methods",
        "one method or number changed, 60 Hz",
        ("methods", "skin", "max_slides", "path_tolerance"),
        NS_STEP,
        QUERIES,
        ("precise; 60 Hz",),
    ),
    Topic(
        "slices",
        "long steps, 10 and 20 Hz",
        ("arc_tolerance; 20 Hz", "max_substep; stepped; 10 Hz", "max_substeps; stepped; 10 Hz"),
        NS_SECOND,
        QUERIES_SECOND,
        ("precise; 10 Hz", "precise; 20 Hz"),
    ),
    Topic(
        "backends",
        "every backend, 60 Hz",
        (
            "native",
            "ccd advance",
            "ccd GJK",
            "ccd MPR",
            "fcl descend",
            "fcl collide",
            "box2d",
            "box2d 2.4",
        ),
        NS_STEP,
        TESTS_STEP,
    ),
)
COST_CURVES = ("cache_margin", "switches")

SCENES = {
    "triangles": "capsules and spheres against single triangles",
    "meshes": "capsules and spheres against small meshes",
    "convex": "capsules and spheres against hulls and boxes",
    "hard": "capsules and spheres: slivers, tiny and huge triangles, sharp hulls, far from the origin",
    "boxes": "boxes against triangles, meshes, hulls and boxes",
    "outlines": "all shapes in a plane against outlines and hulls, backends of two dimensions too",
    "slides": "the exact slides: walls, edges, gutters, wedges",
    "bare slides": "the exact slides along bare walls",
    "playground": "the generated playground",
    "dungeon": "the level dungeon, of a shooter",
    "tiles_2d": "a side-scroller of 1002 bodies",
    "hills": "generated hills",
    "plane": "a plane",
}


def scenes_of(rows: Sequence[Row]) -> list[str]:
    return list(dict.fromkeys(r.scene for r in rows))


def describe(scene: str) -> str:
    return SCENES.get(scene, scene)


def describe_walk(scene: str) -> str:
    """ "walking in dungeon", in words."""
    what, _, level = scene.partition(" in ")
    return f"{what} on {describe(level)}"


def _errors_and_counts(rows: Sequence[Row], work: Scale, count: Scale) -> Figure:
    """Work over the median error, over the 99th percentile, and the count that no machine changes."""
    counted = any(count.of(r) == count.of(r) for r in rows)
    figure, axes = panels(3 if counted else 2)
    scatter(axes[0], rows, MEDIAN_ERROR, work)
    scatter(axes[1], rows, P99_ERROR, work, with_front=True)
    axes[0].set_title("half of the answers")
    axes[1].set_title("99 % of the answers, and the front")
    if counted:
        scatter(axes[2], rows, P99_ERROR, count)
        axes[2].set_title("the same on every machine")
    return figure


def sweep_charts(rows: Sequence[Row]) -> list[Chart]:
    charts = []
    for scene in scenes_of(rows):
        own = [r for r in rows if r.scene == scene]
        caption = (
            f"Sweeps of {describe(scene)}, {own[0].samples} of them. Error: how far off its margin the shape is"
            " where the answer stops it, against the stored truth (quad precision). Time: median over the sweeps,"
            " each the least of some rounds, after the announcement that a step makes. Points of one curve differ"
            " by the number beside them; a red cross fails as often as it says (missed, hit nothing, gave up, or a"
            " normal more than 2 degrees off). Grey: the Pareto front. Errors below 1e-12 m are drawn there."
        )
        figure = _errors_and_counts(own, NS_SWEEP, TESTS)
        charts.append(Chart(f"sweeps-{scene}", f"Sweeps: {describe(scene)}", caption, figure, own))
    return charts


def _doubt(rows: Sequence[Row]) -> str:
    for row in rows:
        if row.role == "reference":
            return (
                f" The reference itself moves by {row.error_p99_m:.1e} m (99 %) when its rate is halved; {row.why}, "
                "left out."
            )
    return ""


def _cost_chart(scene: str, rows: Sequence[Row]) -> Chart | None:
    own = [r for r in rows if r.curve in COST_CURVES or r.setting == "precise; 60 Hz"]
    if len(own) < 2:
        return None
    figure, (times, counts) = panels(2, width=5.5, height=0.9 + 0.26 * len(own), left=1.7)
    names = [r.setting for r in own]
    dots(
        times,
        names,
        [("median", [r.ns_p50 for r in own]), ("99th percentile", [r.ns_p99 for r in own])],
        Scale(lambda r: r.ns_p50, "time of a step", "s", 1e-9),
    )
    dots(
        counts,
        [""] * len(own),
        [("queries", [r.queries for r in own]), ("narrow tests", [r.tests for r in own])],
        Scale(lambda r: r.queries, "per step"),
    )
    caption = (
        f"What only costs: cache margin, and what is switched off, on {describe(scene)} at 60 Hz. The errors are "
        "the same to the bit: see the table."
    )
    return Chart(
        f"movement-{scene.replace(' ', '-')}-caches",
        f"Movement on {describe(scene)}: caches and switches",
        caption,
        figure,
        own,
    )


SLIDE = "the farthest that a character is from the exact path (tests/accuracy), flying without gravity, drag and steps"
ERRORS = {
    "slides": SLIDE,
    "bare slides": SLIDE + "; the path touches the walls, so that every skin is off it",
    "plane": "how far off the closed form of its numbers a character is, every 0.1 s of speeding up, braking and a jump",
}
WINDOWS = (
    "the farthest that a character is from its reference path during a second of movement from rest (the same start and"
    " numbers, all planes at once, on native; exact ones at 1920 Hz, stepped ones, whose law along walls is"
    " another one, stepped at 7680 Hz)"
)


def _movement_caption(scene: str, topic: Topic, doubt: str) -> str:
    error = ERRORS.get(scene, WINDOWS)
    slides = scene in ("slides", "bare slides")
    skin = "skin" in topic.curves and not slides
    costs = (
        "Time and queries: of these steps. A red cross reported that it was stuck, gave up or hit its cap of queries."
        if slides
        else "Time and queries: wandering characters on the same level, each with a mover of its own. A red cross went"
        " through something, ended more than 1 mm inside, or reported that it gave up or hit its cap of queries."
    )
    last = " The skin is no matter of accuracy but of what is right, and on no front." if skin else ""
    return (
        f"Whole movement on {describe(scene)}: {topic.title}. Error: {error}.{doubt} {costs} Grey: the Pareto front."
        f"{last}"
    )


def movement_charts(rows: Sequence[Row]) -> list[Chart]:
    charts = []
    for scene in scenes_of(rows):
        here = [r for r in rows if r.scene == scene]
        for topic in TOPICS:
            own = [r for r in here if r.curve in topic.curves or r.setting in topic.also]
            if len(own) < 2:
                continue
            caption = _movement_caption(scene, topic, _doubt(here))
            figure = _errors_and_counts(own, topic.work, topic.count)
            charts.append(
                Chart(
                    f"movement-{scene.replace(' ', '-')}-{topic.name}",
                    f"Movement on {describe(scene)}: {topic.title}",
                    caption,
                    figure,
                    own,
                )
            )
        cost = _cost_chart(scene, here)
        if cost:
            charts.append(cost)
    return charts


def _ratios(names: Sequence[str], on: dict[str, Row], off: dict[str, Row], what: str) -> list[float]:
    """Without it over with it; NaN where there is nothing to divide by."""
    pairs = [(getattr(off[n], what), getattr(on[n], what)) for n in names]
    return [a / b if b > 0 and a > 0 else float("nan") for a, b in pairs]


def shortcut_charts(rows: Sequence[Row]) -> list[Chart]:
    charts = []
    for scene in scenes_of(rows):
        on = {r.curve: r for r in rows if r.scene == scene and r.setting == "on"}
        off = {r.curve: r for r in rows if r.scene == scene and r.setting == "off"}
        names = [name for name in on if name in off]
        figure, (times, counts) = panels(2, width=6.6, height=1.1 + 0.3 * len(names), left=2.6)
        figure.subplots_adjust(wspace=0.12)
        dots(
            times,
            names,
            [
                ("median", _ratios(names, on, off, "ns_p50")),
                ("99th percentile", _ratios(names, on, off, "ns_p99")),
                ("mean", _ratios(names, on, off, "ns_mean")),
            ],
            Scale(lambda r: r.ns_p50, "time of a step without it / with it"),
        )
        dots(
            counts,
            [""] * len(names),
            [
                ("queries", _ratios(names, on, off, "queries")),
                ("narrow tests", _ratios(names, on, off, "tests")),
                ("iterations", _ratios(names, on, off, "iterations")),
            ],
            Scale(lambda r: r.queries, "counts of a step without it / with it"),
        )
        for axes in (times, counts):
            axes.axvline(1, color="#444444", linewidth=0.8, zorder=1)
        caption = (
            f"What each shortcut buys, {describe_walk(scene)}: the time of a step, and what it asks and tests, with "
            "the shortcut switched off over that with it on, measured in turns. Right of 1 it pays; no dot: with "
            "it there is nothing left to ask. The table says whether the characters ended at the same bits, and what "
            "the shortcut counted of its savings in a step (report.h says of each what it counts)"
            + (", and what it buys in memory and in opening the world." if any(r.bytes > 0 for r in on.values()) else ".")
        )
        charts.append(
            Chart(
                f"shortcuts-{scene.replace(' ', '-')}",
                f"Shortcuts: {describe_walk(scene)}",
                caption,
                figure,
                [r for r in rows if r.scene == scene],
            )
        )
    return charts


def _budget_chart(rows: Sequence[Row]) -> Chart:
    figure, (left, right) = panels(2, width=5.5)
    scatter(left, rows, P99_ERROR, NS_TICK, with_front=True)
    scatter(right, rows, Scale(lambda r: r.error_max_m, "largest error", "m", floor=ERROR_FLOOR), NS_TICK)
    left.set_title("99 % of the places shown")
    right.set_title("the worst place shown")
    caption = (
        "A budget of error per character (tahr_member.budget): characters on a plane, each alone, beside the same "
        "ones without a budget, every tick for three seconds. Error: how far apart the two are. What is met is "
        "met up to 8 ticks later, and from there on they are two different ways." + budget_gains(rows)
    )
    return Chart("crowds-budgets", "Crowds: a budget of error", caption, figure, list(rows))


def crowd_charts(rows: Sequence[Row]) -> list[Chart]:
    charts = []
    for scene in scenes_of(rows):
        own = [r for r in rows if r.scene == scene]
        if scene == "budgets":
            charts.append(_budget_chart(own))
            continue
        figure, (axes,) = panels(1, width=8)
        over_size(axes, own, [("", NS_TICK)], "characters")
        caption = (
            f"A tick of a crowd on {describe(scene)} at 60 Hz, per character, by the wall clock, median over "
            "ticks. More threads pay where there are cores for them; caches of many characters do not fit into "
            "the processor's." + thread_gains(own)
        )
        charts.append(Chart(f"crowds-{scene}", f"Crowds on {describe(scene)}", caption, figure, own))
    return charts


def scene_charts(rows: Sequence[Row]) -> list[Chart]:
    figure, (times, memory, build) = panels(3)
    over_size(
        times,
        rows,
        [("median", Scale(lambda r: r.ns_p50, "time of a step", "s", 1e-9)), ("p99", Scale(lambda r: r.ns_p99, ""))],
        "triangles",
    )
    over_size(memory, rows, [("", Scale(lambda r: r.bytes, "bytes per triangle"))], "triangles")
    over_size(build, rows, [("", Scale(lambda r: r.build_s, "opening the world", "s"))], "triangles")
    caption = (
        "Hills of more and more triangles, wandering characters at 60 Hz on native. Constant size: triangles of "
        "0.5 m, more of them cover more ground. Constant area: the same 100 m by 100 m cut ever finer. As any mesh: "
        "native is told not to see that they are fields of heights (no_fields) and keeps triangles in a tree."
    )
    return [Chart("scenes", "Size of the scene", caption, figure, list(rows))]


FAMILIES: dict[str, Callable[[Sequence[Row]], list[Chart]]] = {
    "sweeps": sweep_charts,
    "movement": movement_charts,
    "shortcuts": shortcut_charts,
    "crowds": crowd_charts,
    "scenes": scene_charts,
}
