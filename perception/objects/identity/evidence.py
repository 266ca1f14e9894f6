"""All that speaks for or against that a thing which is seen is one that is known, each in one small function.

Measures have their unit in their names; what has none is yes (1) or no (0), or a share or an agreement from 0 to 1.
"It" is what is asked about, and "known" the thing that it is compared with.
"""

from __future__ import annotations

import math
from itertools import product

import numpy as np
from numpy.typing import NDArray

from perception.objects.beliefs import agreement, share_agreement
from perception.objects.furniture.surface import Box
from perception.objects.identity.pair import Array, Moment, Pair, Subject
from perception.objects.seeing.projection import project
from perception.objects.tracking.handled import HandDid
from perception.objects.tracking.relations import support_probability
from perception.objects.tracking.track import Track
from perception.vocabulary import carries_things, category_of, is_of_one_size
from scene_graph.nodes import UNKNOWN_LABEL, ObjectState


def label(pair: Pair) -> float:
    """How far both are called the same."""
    return agreement(pair.it.distribution, pair.known.label.distribution)


def color(pair: Pair) -> float:
    """How far both are of the same colors."""
    return share_agreement(pair.it.colors, pair.known.color.shares)


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


def alike(pair: Pair) -> float:
    """Whether it looks like the known thing."""
    return pair.measure(likeness) >= pair.scales.alike


def same_name(pair: Pair) -> float:
    """Whether the likeliest label is the same."""
    return pair.it.name == pair.known.label.best


def nameless(pair: Pair) -> float:
    """Whether nobody can say what it is."""
    return pair.it.name == UNKNOWN_LABEL


def sureness(pair: Pair) -> float:
    """How sure its name is; 0 if it has none."""
    return 0.0 if pair.it.name == UNKNOWN_LABEL else pair.it.sureness


def known_sureness(pair: Pair) -> float:
    """How sure the name of the known thing is; 0 if it has none."""
    return 0.0 if pair.known.label.best == UNKNOWN_LABEL else pair.known.label.confidence


def surely_another(pair: Pair) -> float:
    """How sure its name is, once it was seen from more than one place: two cannot be in one place, but on it one may
    lie.
    """
    seen_from = pair.it.track.seen_from if pair.it.track is not None else []
    return pair.measure(sureness) if len(seen_from) > 1 else 0.0


def small(pair: Pair) -> float:
    """Whether none of them is furniture."""
    return not pair.it.furniture and (pair.alone or not pair.known.is_furniture)


def furniture(pair: Pair) -> float:
    """Whether all of them are furniture."""
    return pair.it.furniture and (pair.alone or pair.known.is_furniture)


def of_small(pair: Pair) -> float:
    """Whether the known thing is small, whatever it is."""
    return not pair.known.is_furniture


def of_furniture(pair: Pair) -> float:
    """Whether the known thing is furniture, whatever it is."""
    return pair.known.is_furniture


def kin(pair: Pair) -> float:
    """1 if both are furniture or none is; else how far its mask is that of the known thing."""
    return 1.0 if pair.it.furniture == pair.known.is_furniture else _iou(pair)


def mask(pair: Pair) -> float:
    """How far its mask is that of the known thing in the last frame, moved by the camera's motion, from a half on."""
    return 0.5 * (1.0 + _iou(pair))


def whole(pair: Pair) -> float:
    """Whether it was once seen as a whole."""
    return pair.it.whole


def present(pair: Pair) -> float:
    """Whether the known thing is thought to be in its place."""
    return pair.known.state is ObjectState.PRESENT


def missing(pair: Pair) -> float:
    """Whether the known thing was not seen where it should have been."""
    return pair.known.state is ObjectState.MISSING


def held(pair: Pair) -> float:
    """Whether the known thing is in the hand."""
    return pair.known.state is ObjectState.HELD


def is_node(pair: Pair) -> float:
    """Whether the known thing is in the graph."""
    return pair.known.node_id is not None


def impenetrable(pair: Pair) -> float:
    """Whether nothing else can be where the known thing is: it is a node with a name, small and not a container. What
    the hand has just put down is not known to be there before it is seen.
    """
    return is_impenetrable(pair.known)


def container(pair: Pair) -> float:
    """Whether things are put into the known thing."""
    return pair.known.category.container


def supports(pair: Pair) -> float:
    """Whether things stand on the known thing."""
    return pair.known.category.support


def findable(pair: Pair) -> float:
    """Whether the known thing is found by its place: where it slipped to is a guess, and what is missed is not there.
    Else a corner of the table, named by nobody, is the ball that stood there. Only what the hand has just put down is
    found where it must be, though it was not seen at once.
    """
    slipped = pair.known.unseen_since(HandDid.DROPPED)
    return not slipped and (pair.known.state is not ObjectState.MISSING or pair.known.unseen_since(HandDid.PUT))


def awaited(pair: Pair) -> float:
    """Whether the hand has put the known thing down and it was not seen since."""
    return pair.known.unseen_since(HandDid.PUT)


def let_slip(pair: Pair) -> float:
    """Whether the known thing slipped from the hand, or the hand closed where it was, and it was not seen since."""
    return pair.known.unseen_since(HandDid.DROPPED, HandDid.TOUCHED)


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


def being_missed(pair: Pair) -> float:
    """Whether the last frames that should have shown the known thing did not."""
    return pair.known.misses > 0


def unseen_s(pair: Pair) -> float:
    """How much longer ago the known thing was seen than it."""
    return pair.it.last_seen_s - pair.known.last_seen_s


def later(pair: Pair) -> float:
    """Whether the known thing was never seen since it is: two that were seen at the same time are two."""
    return pair.known.last_seen_s < pair.it.first_seen_s


def same_room(pair: Pair) -> float:
    """Whether both are in one room."""
    return pair.it.room == pair.known.room


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


def away_m(pair: Pair) -> float:
    """Horizontal distance of both in one room."""
    return float(np.hypot(*(pair.it.box.center - pair.known.position)[:2])) if pair.measure(same_room) else np.inf


def near(pair: Pair) -> float:
    """1 where a missing thing was, and less the farther from there, until it is likelier to be carried than fallen."""
    if pair.known.state is not ObjectState.MISSING or not pair.measure(same_room):
        return 0.0
    return float(np.exp(-np.linalg.norm(pair.it.box.center - pair.known.position) / pair.scales.near_m))


def may_lie_here(pair: Pair) -> float:
    """Whether the known thing may be here: what slipped from the hand lies near there or on a floor, and a look-alike
    that turns up on another table is another one.
    """
    if not pair.known.unseen_since(HandDid.DROPPED):
        return True
    bottom_m = float(pair.it.box.center[2]) - pair.it.box.size_m[2] / 2.0
    close = np.linalg.norm(pair.it.box.center - pair.known.position) < pair.scales.near_m
    return bottom_m < pair.scales.floor_m or bool(pair.measure(same_room) and close)


def touching(pair: Pair) -> float:
    """Whether both are said to be in one place, so that there can be only one."""
    apart_m = np.abs(pair.it.box.center - pair.known.position)
    sides_m = np.asarray(pair.it.box.size_m) + np.asarray(pair.known.box.size_m)
    return pair.measure(same_room) > 0.0 and bool(np.all(apart_m < sides_m / 2))


def off_middle(pair: Pair) -> float:
    """How far its middle is from that of the known thing, as a share of the width of the narrower."""
    return pair.measure(away_m) / min(*pair.it.box.size_m[:2], *pair.known.box.size_m[:2])


def left(pair: Pair) -> float:
    """Probability that the known thing has left its place: certain when it is missing, and growing with the time since
    it was last seen.
    """
    age_s = max(pair.it.first_seen_s - pair.known.last_seen_s, 0.0)
    return 1.0 - pair.known.existence * float(np.exp(-age_s / pair.scales.tau_s))


def at_large(pair: Pair) -> float:
    """Chance that the known thing, if it has left its place, is here: what is missed must be somewhere."""
    return 1.0 if pair.known.state is ObjectState.MISSING else pair.scales.at_large


def looked_before(pair: Pair) -> float:
    """Whether one had looked here before and seen nothing: a look-alike that nobody has seen before is unlikely then,
    and quite possible in a place seen for the first time.
    """
    seen_s = pair.moment.looked_before.get(_place_of(pair) or pair.it.room, np.inf)
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


def fixed(pair: Pair) -> float:
    """Whether the known thing is built in or connected, and nobody has seen its place empty."""
    return is_of_one_size(pair.known.label.best) and pair.known.state is not ObjectState.MISSING


def inside(pair: Pair) -> float:
    """Share of its points that are in the box of the known thing."""
    scales = pair.scales
    margin_m = scales.furniture_margin_m if pair.known.is_furniture else scales.thing_margin_m
    return float(pair.known.box.contains(pair.points, margin_m).mean()) if len(pair.points) else 0.0


def covers(pair: Pair) -> float:
    """Share of the points of the known thing that are in its box."""
    points = pair.known.surface_points
    return float(pair.it.box.contains(points, pair.scales.furniture_margin_m).mean()) if len(points) else 0.0


def meeting(pair: Pair) -> float:
    """Whether the two are near enough in one room to have anything in common."""
    reach_m = sum(float(np.hypot(*box.size_m[:2])) / 2.0 for box in (pair.it.box, pair.known.box))
    return pair.measure(away_m) <= reach_m + pair.scales.furniture_margin_m


def middle_inside(pair: Pair) -> float:
    """Whether its middle is where the known thing is."""
    return bool(pair.known.box.contains(pair.center[None], pair.scales.thing_margin_m)[0])


def middle_shown(pair: Pair) -> float:
    """Whether its middle is where the known thing is, or shows in the picture as a part of that."""
    sight, center = pair.moment.sight, pair.here(pair.it.box.center[None])
    if pair.measure(middle_inside) or sight is None or center is None:
        return pair.measure(middle_inside)
    center = sight.view.T_camera_room.apply(center)
    (pixel,), (depth_m,) = project(center, sight.view.intrinsics)
    masks = [d.mask for d in sight.detections if pair.moment.matches.get(d.index) is pair.known]
    u, v = (round(float(each)) for each in pixel) if depth_m > pair.scales.slack_m else (-1, -1)
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


def length_share(pair: Pair) -> float:
    """How long it is, measured by the known thing."""
    return max(pair.it.box.size_m) / max(pair.known.box.size_m)


def shared_out(pair: Pair) -> float:
    """Share of its points that are where several known things are, unless one of them has as good as all of it."""
    within = np.array([within for _, within in sharers(pair.it, pair.moment)])
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
    usual_m, own_m = _usual_m(name), _long_m(pair.it.box)
    rest_m = _long_m(known.box) - own_m
    as_usual = abs(own_m - usual_m) < pair.scales.usual_share * usual_m
    return as_usual and rest_m >= pair.scales.rest_share * _usual_m(known.label.best)


def in_longer(pair: Pair) -> float:
    """Whether one of them is known well to stand by itself, and the other is much longer."""
    longer, shorter = pair.known, pair.it.track
    if shorter is None or _long_m(shorter.box) > _long_m(longer.box):
        longer, shorter = shorter or longer, pair.known
    return shorter.stands_by_itself and _long_m(longer.box) > pair.scales.longer * _long_m(shorter.box)


def shorter(pair: Pair) -> float:
    """Whether it is no longer than the known thing."""
    return _long_m(pair.it.box) <= _long_m(pair.known.box)


def hand_m(pair: Pair) -> float:
    """How far from the fingers it is: what they hold or have just put down shows between them in pieces that look like
    many things.
    """
    away = _from_hand(pair)
    return float(np.linalg.norm(away)) if away is not None else np.inf


def arm_m(pair: Pair) -> float:
    """How far from the fingers, seen from above, it is of an arm that is stretched out: that cuts it into pieces and
    hides what is beside it, so neither its looks nor its absence tell anything.
    """
    away = _from_hand(pair)
    sight = pair.moment.sight
    return float(np.hypot(*away[:2])) if away is not None and sight is not None and sight.reaching else np.inf


def person_m(pair: Pair) -> float:
    """How far it is from where somebody stands: of furniture, the middle of what is seen, for its depth is a guess."""
    sight, points = pair.moment.sight, pair.it.points
    middle = pair.here(np.median(points, axis=0) if len(points) else pair.it.box.center)
    if sight is None or middle is None or not len(sight.persons):
        return np.inf
    return float(np.hypot(*(sight.persons - middle[:2]).T).min())


def on_floor(pair: Pair) -> float:
    """Whether it is furniture that stands on the floor, as far as is known."""
    return pair.it.furniture and (pair.it.category.floor or not pair.it.category.known)


def in_walls(pair: Pair) -> float:
    """Share of its points that are of walls: what stands on the floor stands before them."""
    sight, points = pair.moment.sight, pair.here(pair.it.points)
    return sight.surroundings.in_walls(points) if sight is not None and points is not None else 0.0


def is_impenetrable(track: Track) -> bool:
    """As ``impenetrable``."""
    known = track.node_id is not None and track.state is ObjectState.PRESENT and track.label.best != UNKNOWN_LABEL
    return known and not track.unseen_since(HandDid.PUT) and not track.is_furniture and not track.category.container


def sharers(it: Subject, moment: Moment) -> list[tuple[Track, NDArray[np.bool_]]]:
    """Known things of its kind in places where it is, and which of its points, (N,), each of them has."""
    scales, found = moment.scales, []
    for known in moment.known:
        margin_m = scales.furniture_margin_m if known.is_furniture else scales.thing_margin_m
        solid = known.state is ObjectState.PRESENT if it.furniture else is_impenetrable(known)
        if solid and known.is_furniture == it.furniture and known is not it.track and known.node_id is not None:
            within = known.box.contains(it.seen_from(known.room, moment)[1], margin_m)
            found += [(known, within)] if within.any() else []
    return found


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


def _from_hand(pair: Pair) -> Array | None:
    """From the fingers to its middle, (3,); ``None`` where they are not known."""
    sight, middle = pair.moment.sight, pair.here(pair.it.box.center)
    return middle - sight.hand if sight is not None and sight.hand is not None and middle is not None else None


def _long_m(box: Box) -> float:
    return max(box.size_m[:2])


def _usual_m(name: str) -> float:
    return max(category_of(name).size_m[:2])


def _place_of(pair: Pair) -> str | None:
    """The node of what carries it, ``None`` for what lies on the floor."""
    scales, box, room = pair.scales, pair.it.box, pair.it.room
    carriers = [t for t in pair.moment.known if t.room == room and carries_things(t.label.best, t.box.size_m)]
    gap = {"sigma_m": scales.contact_sigma_m, "rim_m": scales.rim_m}
    chances = [(support_probability(box, t.box, t.category, **gap)[1], t) for t in carriers]
    best = max(chances, key=lambda pair: (pair[0], -pair[1].number), default=None)
    return best[1].node_id if best is not None and best[0] > scales.carries else None
