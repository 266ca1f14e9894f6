"""One mission in a picture."""

from __future__ import annotations

import io

import matplotlib.image
import numpy as np

from evaluations.missions.filmstrip import MOST, Still, draw_filmstrip
from mission_scenes import FLAT


def test_a_filmstrip_shows_the_first_and_the_last_of_many_pictures(tmp_path):
    jpeg = io.BytesIO()
    matplotlib.image.imsave(jpeg, np.zeros((24, 32, 3), np.uint8), format="jpeg")
    stills = [
        Still(stamp_s=float(n), at=(1.0 + n / 10, 1.0), caption=f"picture {n}", jpeg=jpeg.getvalue() if n else None)
        for n in range(MOST + 5)
    ]
    few, many = tmp_path / "few.png", tmp_path / "new" / "many.png"
    draw_filmstrip(FLAT, [(1.0, 1.0), (2.0, 1.5)], stills[:3], "done: put the cup on the desk", few)
    draw_filmstrip(FLAT, [], stills, "done: put the cup on the desk", many)
    assert matplotlib.image.imread(many).shape[0] > matplotlib.image.imread(few).shape[0] > 0
