"""All that speaks for or against that a thing which is seen is one that is known, each in one small function.

Measures have their unit in their names; what has none is yes (1) or no (0), or a share or an agreement from 0 to 1.
"It" is what is asked about, and "known" the thing that it is compared with.
"""

from __future__ import annotations

import math
from itertools import product

import numpy as np

from perception.objects.beliefs import agreement, share_agreement
from perception.objects.furniture.surface import Box
from perception.objects.identity.pair import Array, Evidence, Pair, Subject
from perception.objects.seeing.projection import project
from perception.objects.tracking.handled import HandDid
from perception.objects.tracking.track import Track
from perception.vocabulary import Category, category_of, is_of_one_size
from scene_graph.nodes import UNKNOWN_LABEL, ObjectState


def fact(name: str, measure: Evidence) -> Evidence:
    """An evidence of one expression."""
    measure.__name__ = name
    return measure


label = fact("label", lambda p: agreement(p.it.distribution, p.known.label.distribution))
"""How far both are called the same."""
color = fact("color", lambda p: share_agreement(p.it.colors, p.known.color.shares))
"""How far both are of the same colors."""
alike = fact("alike", lambda p: p.measure(likeness) >= p.scales.alike)
"""Whether it looks like the known thing."""
same_name = fact("same_name", lambda p: p.it.name == p.known.label.best)
"""Whether the likeliest label is the same."""
nameless = fact("nameless", lambda p: p.it.name == UNKNOWN_LABEL)
"""Whether nobody can say what it is."""
sureness = fact("sureness", lambda p: p.it.sureness * (p.it.name != UNKNOWN_LABEL))
"""How sure its name is; 0 if it has none."""
known_sureness = fact("known_sureness", lambda p: p.known.label.confidence * (p.known.label.best != UNKNOWN_LABEL))
"""How sure the name of the known thing is; 0 if it has none."""
small = fact("small", lambda p: not p.it.furniture and (p.alone or not p.known.is_furniture))
"""Whether none of them is furniture."""
furniture = fact("furniture", lambda p: p.it.furniture and (p.alone or p.known.is_furniture))
"""Whether all of them are furniture."""
of_furniture = fact("of_furniture", lambda p: p.known.is_furniture)
"""Whether the known thing is furniture, whatever it may be."""
kin = fact("kin", lambda p: 1.0 if p.it.furniture == p.known.is_furniture else _iou(p))
"""1 if both are furniture or none is; else how far its mask is that of the known thing."""
mask = fact("mask", lambda p: 0.5 * (1.0 + _iou(p)))
"""How far its mask is that of the known thing in the last frame, moved by the camera's motion, from a half on."""
whole = fact("whole", lambda p: p.it.whole)
"""Whether it was once seen as a whole."""
present = fact("present", lambda p: p.known.state is ObjectState.PRESENT)
"""Whether the known thing is thought to be in its place."""
missing = fact("missing", lambda p: p.known.state is ObjectState.MISSING)
"""Whether the known thing was not seen where it should have been."""
held = fact("held", lambda p: p.known.state is ObjectState.HELD)
"""Whether the known thing is in the hand."""
is_node = fact("is_node", lambda p: p.known.node_id is not None)
"""Whether the known thing is in the graph."""
impenetrable = fact("impenetrable", lambda p: p.known.impenetrable)
"""Whether nothing else can be where the known thing is."""
container = fact("container", lambda p: p.known.category.container)
"""Whether things are put into the known thing."""
supports = fact("supports", lambda p: p.known.category.support)
"""Whether things stand on the known thing."""
awaited = fact("awaited", lambda p: p.known.unseen_since(HandDid.PUT))
"""Whether the hand has put the known thing down and it was not seen since."""
let_slip = fact("let_slip", lambda p: p.known.unseen_since(HandDid.DROPPED, HandDid.TOUCHED))
"""Whether the known thing slipped from the hand, or the hand closed where it was, and it was not seen since."""
being_missed = fact("being_missed", lambda p: p.known.misses > 0)
"""Whether the last frames that should have shown the known thing did not."""
unseen_s = fact("unseen_s", lambda p: p.it.last_seen_s - p.known.last_seen_s)
"""How much longer ago the known thing was seen than it."""
since_s = fact("since_s", lambda p: p.it.first_seen_s - p.known.last_seen_s)
"""How long the known thing had not been seen when it was first seen."""
later = fact("later", lambda p: p.measure(since_s) > 0.0)
"""Whether the known thing was never seen since it is: two that were seen at the same time are two."""
same_room = fact("same_room", lambda p: p.it.room == p.known.room)
"""Whether both are in one room."""
apart_m = fact("apart_m", lambda p: _distance_m(p.it.box.center, p.known.position, p.measure(same_room)))
"""Distance of both in one room."""
away_m = fact("away_m", lambda p: _distance_m(p.it.box.center[:2], p.known.position[:2], p.measure(same_room)))
"""The same, horizontally."""
near = fact("near", lambda p: math.exp(-p.measure(apart_m) / p.scales.near_m) * p.measure(missing))
"""1 where a missing thing was, and less the farther from there, until it is likelier to be carried than fallen."""
off_middle = fact("off_middle", lambda p: p.measure(away_m) / min(*p.it.box.size_m[:2], *p.known.box.size_m[:2]))
"""How far its middle is from that of the known thing, as a share of the width of the narrower."""
left = fact("left", lambda p: 1.0 - p.known.existence * math.exp(min(-p.measure(since_s), 0.0) / p.scales.tau_s))
"""Probability that the known thing has left its place: certain when it is missing, and growing with the time since it
was last seen.
"""
at_large = fact("at_large", lambda p: 1.0 if p.known.state is ObjectState.MISSING else p.scales.at_large)
"""Chance that the known thing, if it has left its place, is here: what is missed must be somewhere."""
fixed = fact("fixed", lambda p: is_of_one_size(p.known.label.best) and p.known.state is not ObjectState.MISSING)
"""Whether the known thing is built in or connected, and nobody has seen its place empty."""
inside = fact("inside", lambda p: _share(p.points, p.known.box, p.scales.margin_m(furniture=p.known.is_furniture)))
"""Share of its points that are where the known thing is."""
covers = fact("covers", lambda p: _share(p.known.surface_points, p.it.box, p.scales.furniture_margin_m))
"""Share of the points of the known thing that are where it is."""
middle_inside = fact("middle_inside", lambda p: bool(p.known.box.contains(p.center[None], p.scales.thing_margin_m)[0]))
"""Whether its middle is where the known thing is."""
stands_there = fact("stands_there", lambda p: bool(p.it.box.contains(p.known.position[None])[0]))
"""Whether the middle of the known thing is where it is."""
length_share = fact("length_share", lambda p: max(p.it.box.size_m) / max(p.known.box.size_m))
"""How long it is, measured by the known thing."""
shorter = fact("shorter", lambda p: _long_m(p.it.box) <= _long_m(p.known.box))
"""Whether it is no longer than the known thing."""
on_floor = fact("on_floor", lambda p: p.it.furniture and (p.it.category.floor or not p.it.category.known))
"""Whether it is furniture that stands on the floor, as far as is known."""


def size(pair: Pair) -> float:
    """1 for equal sizes, falling with the ratio of sorted sides: what has toppled is as large as it was."""
    sides = zip(sorted(pair.it.box.size_m), sorted(pair.known.box.size_m), strict=True)
    noise_m = pair.scales.size_noise_m
    worst = max(max(abs(a - b) - noise_m, 0.0) / max(a, b, 1e-3) for a, b in sides)
    return float(np.exp(-0.5 * (worst / pair.scales.size_spread) ** 2))


def likeness(pair: Pair) -> float:
    """How far label, color and size agree."""
    value = pair.measure(label)
    return value * pair.measure(color) * pair.measure(size) if value > 0.0 else 0.0


def surely_another(pair: Pair) -> float:
    """How sure its name is, once it was seen from more than one place: two cannot be in one place, but on it one may
    lie.
    """
    seen_from = pair.it.track.seen_from if pair.it.track is not None else []
    return pair.measure(sureness) if len(seen_from) > 1 else 0.0


def findable(pair: Pair) -> float:
    """Whether the known thing is found by its place: where it slipped to is a guess, and what is missed is not there.
    Else a corner of the table, named by nobody, is the ball that stood there. Only what the hand has just put down is
    found where it must be, though it was not seen at once.
    """
    slipped = pair.known.unseen_since(HandDid.DROPPED)
    return not slipped and (pair.known.state is not ObjectState.MISSING or pair.known.unseen_since(HandDid.PUT))


def put_by_hand(pair: Pair) -> float:
    """Whether the hand itself has put it there, or has closed on it: one knows which it is."""
    handled = pair.it.track.handled if pair.it.track is not None else None
    return handled is not None and handled.did in {HandDid.PUT, HandDid.TOUCHED}


def taken_from_m(pair: Pair) -> float:
    """How far from it is where the hand took the known thing."""
    handled = pair.known.handled
    if handled is None or handled.did is not HandDid.TAKEN or handled.room != pair.it.room:
        return np.inf
    return float(np.linalg.norm(handled.position - pair.it.box.center))


def seen_now(pair: Pair) -> float:
    """Whether the known thing is seen in this frame, as another than it."""
    return any(track is pair.known for track in pair.moment.matches.values()) and pair.known is not pair.it.track


def place(pair: Pair) -> float:
    """1 where the known thing is expected in the next frame, as good as nothing where the gate ends."""
    scales, known = pair.scales, pair.known
    away_m = math.dist(pair.center, known.position)
    if away_m > scales.reach_m:
        return 0.0
    slack_m = scales.slack_m + scales.slack_share * min(known.box.size_m[:2])
    slack_m += 0.0 if pair.it.whole else scales.part_slack_m
    squared = away_m**2 / (pair.moment.spread_m2(known) + pair.it.spread_m2 + slack_m**2)
    return math.exp(-2.5 * squared / scales.gate_sigmas**2)


def may_lie_here(pair: Pair) -> float:
    """Whether the known thing may be here: what slipped from the hand lies near there or on a floor, and a look-alike
    that turns up on another table is another one.
    """
    if not pair.known.unseen_since(HandDid.DROPPED):
        return True
    bottom_m = float(pair.it.box.center[2]) - pair.it.box.size_m[2] / 2.0
    return bottom_m < pair.scales.floor_m or pair.measure(apart_m) < pair.scales.near_m


def touching(pair: Pair) -> float:
    """Whether both are said to be in one place, so that there can be only one."""
    apart_m = np.abs(pair.it.box.center - pair.known.position)
    sides_m = np.asarray(pair.it.box.size_m) + np.asarray(pair.known.box.size_m)
    return pair.measure(same_room) > 0.0 and bool(np.all(apart_m < sides_m / 2))


def looked_before(pair: Pair) -> float:
    """Whether one had looked here before and seen nothing: a look-alike that nobody has seen before is unlikely then,
    and quite possible in a place seen for the first time.
    """
    seen_s = pair.moment.looked_before.get(pair.moment.carrier(pair.it) or pair.it.room, np.inf)
    return seen_s < pair.it.first_seen_s - pair.scales.looked_s


def rivals(pair: Pair) -> float:
    """How many others it might be as well, if the known one is not missed: none of several look-alikes that are in
    their places is taken for the one that was moved.
    """
    if pair.known.state is ObjectState.MISSING:
        return 0.0
    others = [Pair(pair.it, other, pair.moment) for other in pair.moment.known if other is not pair.known]
    return float(sum(_could_be(other) and alike(other) > 0.0 for other in others))


def twins(pair: Pair) -> float:
    """How many others like the known one are in their places, be they known for long: where such things come in
    numbers, one that nobody had noticed, behind another, is likelier than one that was moved.
    """
    others = [t for t in pair.moment.known if t is not pair.known and t is not pair.it.track]
    others = [t for t in others if t.state is ObjectState.PRESENT and t.is_furniture == pair.known.is_furniture]
    return float(sum(alike(Pair(Subject.of(other), pair.known, pair.moment)) > 0.0 for other in others))


def meeting(pair: Pair) -> float:
    """Whether the two are near enough in one room to have anything in common."""
    reach_m = sum(math.hypot(*box.size_m[:2]) / 2.0 for box in (pair.it.box, pair.known.box))
    return pair.measure(away_m) <= reach_m + pair.scales.furniture_margin_m


def middle_shown(pair: Pair) -> float:
    """Whether its middle is where the known thing is, or shows in the picture as a part of that."""
    sight = pair.moment.sight
    if pair.measure(middle_inside) or sight is None:
        return pair.measure(middle_inside)
    center = sight.view.T_camera_room.apply(pair.here(pair.it.box.center[None]))
    (pixel,), _ = project(center, sight.view.intrinsics)
    masks = [d.mask for d in sight.detections if pair.moment.matches.get(d.index) is pair.known]
    u, v = np.nan_to_num(np.round(pixel), nan=-1.0).astype(int)
    return any(0 <= v < m.shape[0] and 0 <= u < m.shape[1] and bool(m[v, u]) for m in masks)


def enclosed(pair: Pair) -> float:
    """Whether all of its corners are where the known thing is."""
    half = np.array(pair.it.box.size_m) / 2.0
    corners = pair.it.box.place(half * np.array(tuple(product((-1.0, 1.0), repeat=3))))
    return bool(pair.known.box.contains(corners, pair.scales.thing_margin_m).all())


def thin_m(pair: Pair) -> float:
    """How thin it is in one direction of the floor, if it is upright; infinite if it lies."""
    thin = min(pair.it.box.size_m[:2])
    return thin if pair.it.box.size_m[2] > thin else np.inf


def shared_out(pair: Pair) -> float:
    """Share of its points that are where several known things are, unless one of them has as good as all of it."""
    within = np.array([within for _, within in pair.moment.sharers(pair.it)])
    several = len(within) > 1 and float(within.mean(axis=1).max()) <= pair.scales.whole_share
    return float(within.any(axis=0).mean()) if several else 0.0


def over(pair: Pair) -> float:
    """Share of its points that are of the known furniture, or stand on that: nobody stands where a table is, and before
    it or behind it there would be something of them; whoever sits on a seat rises above it.
    """
    center, size_m = pair.known.position, pair.known.box.size_m
    seat_m = size_m[2] + pair.scales.seat_height_m
    height_m = seat_m if pair.known.category.levels else pair.scales.person_height_m
    middle = np.array((center[0], center[1], height_m / 2.0))
    column = Box(middle, (size_m[0], size_m[1], height_m), pair.known.box.yaw_rad)
    return float(column.contains(pair.points, pair.scales.thing_margin_m).mean())


def fits_row(pair: Pair) -> float:
    """Whether it is of a kind of one size everywhere and of that size, and known furniture without it is still as long
    as its kind may be.
    """
    name, known = pair.it.name, pair.known
    if not is_of_one_size(name):
        return False
    usual_m, own_m = _long_m(category_of(name)), _long_m(pair.it.box)
    rest_m = _long_m(known.box) - own_m
    as_usual = abs(own_m - usual_m) < pair.scales.usual_share * usual_m
    return as_usual and rest_m >= pair.scales.rest_share * _long_m(category_of(known.label.best))


def in_longer(pair: Pair) -> float:
    """Whether one of them is known well to stand by itself, and the other is much longer."""
    known, it, times = pair.known, pair.it.track, pair.scales.longer
    pairs = ((known, it), (it, known)) if it is not None else ()
    return any(one.stands_by_itself and _long_m(other.box) > times * _long_m(one.box) for one, other in pairs)


def hand_m(pair: Pair) -> float:
    """How far from the fingers it is: what they hold or have just put down shows between them in pieces that look like
    many things.
    """
    sight, middle = pair.moment.sight, pair.here(pair.it.box.center)
    return math.dist(middle, sight.hand) if sight is not None and sight.hand is not None else math.inf


def arm_m(pair: Pair) -> float:
    """How far from the fingers, seen from above, it is of an arm that is stretched out: that cuts it into pieces and
    hides what is beside it, so neither its looks nor its absence tell anything.
    """
    sight, middle = pair.moment.sight, pair.here(pair.it.box.center)
    if sight is None or sight.hand is None or not sight.reaching:
        return math.inf
    return math.dist(middle[:2], sight.hand[:2])


def person_m(pair: Pair) -> float:
    """How far it is from where somebody stands: of furniture, the middle of what is seen, for its depth is a guess."""
    persons, points = pair.moment.sight.persons if pair.moment.sight is not None else (), pair.it.points
    middle = pair.here(np.median(points, axis=0) if len(points) else pair.it.box.center)
    return min((math.dist(middle[:2], person) for person in persons), default=math.inf)


def in_walls(pair: Pair) -> float:
    """Share of its points that are of walls: what stands on the floor stands before them."""
    sight = pair.moment.sight
    return sight.surroundings.in_walls(pair.here(pair.it.points)) if sight is not None else 0.0


def _distance_m(one: Array, other: Array, in_one_room: float) -> float:
    return math.dist(one, other) if in_one_room else math.inf


def _share(points: Array, box: Box, margin_m: float) -> float:
    return float(box.contains(points, margin_m).mean()) if len(points) else 0.0


def _iou(pair: Pair) -> float:
    detection = pair.it.source
    return 0.0 if isinstance(detection, Track) else pair.moment.iou.get((pair.known.number, detection.index), 0.0)


def _could_be(pair: Pair) -> bool:
    """Whether it may be the known thing, moved, for all that is known of where that was seen, and when."""
    if pair.known.state is ObjectState.HELD or pair.it.furniture != pair.known.is_furniture or not later(pair):
        return False
    if not pair.it.furniture:
        return may_lie_here(pair) > 0.0
    return not fixed(pair) and away_m(pair) < pair.scales.reach_m


def _long_m(box: Box | Category) -> float:
    return max(box.size_m[:2])
