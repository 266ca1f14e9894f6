"""The color of a thing, and what colors it has besides."""

import numpy as np
import pytest

from perception.objects.beliefs import AccentBelief, ColorBelief
from perception.objects.doubles.raycast import Solid, look_at, render
from perception.objects.seeing.color import PALETTE, colors_of, named_color
from scene_graph.nodes import ObjectState
from unit.perception.objects.things import moved, thing

COLORS = [
    ("red", (200, 20, 20)), ("green", (30, 160, 40)), ("blue", (20, 50, 200)), ("yellow", (230, 210, 30)),
    ("orange", (240, 130, 20)), ("purple", (130, 40, 180)), ("pink", (240, 130, 180)), ("brown", (120, 70, 30)),
    ("white", (245, 245, 245)), ("black", (20, 20, 20)), ("gray", (128, 128, 128)), ("cyan", (20, 200, 210)),
]  # fmt: skip


@pytest.mark.parametrize(("name", "rgb"), COLORS)
def test_colors_are_named_as_people_name_them(name, rgb):
    assert named_color(*rgb) == name
    assert name in PALETTE


@pytest.mark.parametrize(("name", "rgb"), COLORS)
def test_a_color_keeps_its_name_on_shaded_faces(name, rgb):
    thing = Solid(label="bottle", center=(0.0, 0.0, 0.3), size_m=(0.3, 0.3, 0.5), cylinder=True, color=rgb)
    belief = ColorBelief()
    for eye in ((-1.5, 0.0, 1.2), (0.0, -1.5, 1.2), (1.0, 1.0, 1.2)):
        rendering = render([thing], look_at(eye, (0.0, 0.0, 0.3)))
        belief.update(colors_of(rendering.rgb, rendering.ids == 0)[0])
    assert belief.best == name


def test_a_handful_of_pixels_of_the_neighbor_does_not_change_the_color():
    rgb = np.zeros((40, 40, 3), dtype=np.uint8)
    rgb[:] = (20, 50, 200)
    rgb[:, :8] = (200, 20, 20)
    votes = colors_of(rgb, np.ones((40, 40), dtype=bool))[0]
    assert max(votes, key=votes.get) == "blue"
    assert sum(votes.values()) == pytest.approx(1.0)
    assert colors_of(rgb, np.zeros((40, 40), dtype=bool))[0] == {}


def phone_on_table(case, table, rows=slice(30, 60), columns=slice(20, 80)):
    """A picture of a phone with a blue screen that fills all but the edges of its case, and the phone's mask."""
    rgb = np.zeros((90, 120, 3), dtype=np.uint8)
    rgb[:] = table
    rgb[rows, columns] = case
    rgb[rows.start + 3 : rows.stop - 3, columns.start + 3 : columns.stop - 3] = (20, 50, 200)
    mask = np.zeros(rgb.shape[:2], dtype=bool)
    mask[rows, columns] = True
    return rgb, mask


def test_the_case_around_a_screen_is_an_accent():
    rgb, mask = phone_on_table(case=(240, 130, 20), table=(245, 245, 245))
    assert colors_of(rgb, mask)[1] == {"orange"}
    rgb, mask = phone_on_table(case=(20, 20, 20), table=(120, 70, 30))
    assert colors_of(rgb, mask)[1] == {"black"}


def test_an_orange_that_lies_against_an_orange_case_does_not_hide_what_color_the_case_is():
    rgb, mask = phone_on_table(case=(240, 130, 20), table=(245, 245, 245))
    rgb[40:80, 80:] = (240, 130, 20)
    assert colors_of(rgb, mask)[1] == {"orange"}
    rgb, mask = phone_on_table(case=(20, 50, 200), table=(245, 245, 245))
    rgb[28:80, 77:] = (240, 130, 20)  # the mask reaches onto it
    assert colors_of(rgb, mask)[1] == frozenset()


def test_what_shines_in_from_around_is_no_accent():
    rgb, mask = phone_on_table(case=(20, 50, 200), table=(200, 20, 20))
    loose = np.zeros_like(mask)
    loose[26:64, 16:84] = True
    assert colors_of(rgb, mask)[1] == frozenset()
    assert colors_of(rgb, loose)[1] == frozenset()


def test_a_thing_that_is_small_in_the_picture_tells_nothing_of_accents():
    rgb, mask = phone_on_table(case=(240, 130, 20), table=(245, 245, 245), rows=slice(30, 38), columns=slice(20, 28))
    assert colors_of(rgb, mask)[1] is None
    assert colors_of(rgb, np.zeros_like(mask))[1] is None


def test_an_accent_shows_in_a_good_part_of_the_frames_that_can_tell():
    belief = AccentBelief()
    belief.update({"orange"})
    assert belief.colors == ()
    for frame in range(20):
        belief.update((None, {"orange"}, {"gray"} if frame == 2 else set())[frame % 3])
    assert belief.colors == ("orange",)
    for _ in range(40):
        belief.update(set())
    assert belief.colors == ()


@pytest.mark.parametrize("other", [{"label": "cup"}, {"color": "red"}, {"size_m": (0.14, 0.14, 0.4)}])
def test_a_thing_of_another_label_color_or_size_is_another_thing(other):
    assert moved(thing(2, seen=(20.0, 21.0), **other), [thing(1, state=ObjectState.MISSING)]) is None


@pytest.mark.parametrize(
    ("name", "rgb"),
    [
        ("brown", (163, 115, 66)), ("brown", (139, 69, 19)), ("blue", (15, 23, 97)), ("red", (115, 15, 26)),
        ("green", (122, 122, 31)), ("green", (140, 217, 38)), ("yellow", (204, 166, 46)), ("cyan", (26, 122, 128)),
        ("pink", (204, 26, 153)), ("beige", (224, 209, 173)), ("white", (204, 224, 235)),
    ],
)  # fmt: skip
def test_less_usual_colors_go_to_the_nearest_common_name(name, rgb):
    assert named_color(*rgb) == name
