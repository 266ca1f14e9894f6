"""From mask and depth to points, centers and sizes."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perception.objects.doubles.raycast import INTRINSICS, Solid, look_at, render, rgbd_frame
from perception.objects.furniture.surface import SurfaceBelief
from perception.objects.seeing.detection import DetectionSettings, detections_of
from perception.objects.seeing.projection import ProjectionSettings, View, back_project, cloud_of, project
from perception.objects.seeing.shape import bounding_rectangle, measure_shape, point_covariance
from perception.objects.tracking.track import Track, TrackSettings
from perception.panoptic import Instance, PanopticScene
from perception.vocabulary import category_of
from scene_graph.geometry.se3 import SE3

TABLE = Solid(label="table", center=(0.0, 0.0, 0.375), size_m=(1.2, 0.8, 0.75))


def view_of(solids, T_room_camera, *, seed=None, T_room_base=None, covariance=None):
    rendering = render(solids, T_room_camera)
    random = np.random.default_rng(seed) if seed is not None else None
    base = T_room_base or SE3.identity()
    frame = rgbd_frame(rendering, stamp_s=0.0, T_base_camera=base.inverse() @ T_room_camera, random=random)
    covariance = covariance if covariance is not None else np.zeros((6, 6))
    return rendering, View.of(frame, room="room_1", T_room_base=base, pose_covariance=covariance)


@given(st.floats(0.0, 319.0), st.floats(0.0, 239.0), st.floats(0.2, 8.0))
def test_projection_undoes_back_projection(u, v, depth_m):
    point = back_project(np.array([u]), np.array([v]), np.array([depth_m]), INTRINSICS)
    pixels, depths = project(point, INTRINSICS)
    assert pixels[0] == pytest.approx((u, v), abs=1e-6)
    assert depths[0] == pytest.approx(depth_m)


def test_points_behind_the_camera_have_no_pixel():
    pixels, _ = project(np.array([[0.0, 0.0, -1.0], [0.0, 0.0, 0.0]]), INTRINSICS)
    assert np.isnan(pixels).all()


def test_points_of_a_mask_lie_on_the_rendered_surface_whatever_the_base_pose():
    for base in (SE3.identity(), SE3.from_xyz_yaw(0.7, -0.4, 0.0, 2.0)):
        rendering, view = view_of([TABLE], look_at((-1.4, 0.3, 1.4), (0.0, 0.0, 0.75)), T_room_base=base)
        cloud = cloud_of(rendering.ids == 0, view, ProjectionSettings(border_px=0))
        offset = np.abs(cloud.points - TABLE.center) - np.array(TABLE.size_m) / 2.0
        assert (offset < 0.02).all()


BODIES = [
    ("bottle", (0.07, 0.07, 0.24), True, 0.0),
    ("can", (0.066, 0.066, 0.12), True, 0.0),
    ("bowl", (0.15, 0.15, 0.07), True, 0.0),
    ("cereal", (0.18, 0.06, 0.22), False, 0.4),
    ("book", (0.22, 0.15, 0.03), False, 0.9),
    ("toy", (0.08, 0.08, 0.08), False, 0.7),
]


@pytest.mark.parametrize(("label", "size_m", "cylinder", "yaw_rad"), BODIES)
@pytest.mark.parametrize("distance_m", [0.8, 1.2])
def test_the_center_of_a_thing_is_found_behind_its_visible_surface(label, size_m, cylinder, yaw_rad, distance_m):
    thing = Solid(
        label=label, center=(0.1, 0.05, 0.75 + size_m[2] / 2), size_m=size_m, yaw_rad=yaw_rad, cylinder=cylinder
    )
    errors = []
    for k, angle in enumerate(np.linspace(0.0, 2.0 * np.pi, 7)[:-1]):
        eye = (0.1 + distance_m * np.cos(angle), 0.05 + distance_m * np.sin(angle), 1.4)
        rendering, view = view_of([TABLE, thing], look_at(eye, (0.1, 0.05, 0.75)), seed=k)
        cloud = cloud_of(rendering.ids == 1, view, ProjectionSettings())
        shape = measure_shape(cloud, view, category_of(label))
        errors.append(shape.center - thing.center)
        assert sorted(shape.size_m) == pytest.approx(sorted(size_m), abs=0.02)
    assert np.abs(np.mean(errors, axis=0)).max() < 0.008
    assert np.linalg.norm(errors, axis=1).max() < 0.015


FLOOR = Solid(label="floor", center=(0.0, 0.0, -0.05), size_m=(6.0, 6.0, 0.1))


@pytest.mark.parametrize(("ground", "ground_m"), [(FLOOR, 0.0), (TABLE, 0.75)])
@pytest.mark.parametrize("size_m", [(0.2, 0.085, 0.035), (0.2, 0.04, 0.04)])
@pytest.mark.parametrize("lost_px", [0, 2])
def test_a_flat_thing_is_as_high_as_it_is_though_from_above_its_side_is_a_row_of_pixels(
    ground, ground_m, size_m, lost_px
):
    """Else the hand closes over it: the middle of what shows of a book on the floor is its top."""
    for distance_m in (0.4, 0.6, 1.0):
        thing = Solid(label="book", center=(0.0, 0.0, ground_m + size_m[2] / 2), size_m=size_m, yaw_rad=0.7)
        rendering, view = view_of([ground, thing], look_at((-distance_m, 0.0, 1.4), (0.0, 0.0, ground_m)), seed=3)
        mask = rendering.ids == 1
        mask &= np.roll(mask, -lost_px, axis=0)
        shape = measure_shape(cloud_of(mask, view, ProjectionSettings()), view, category_of("book"))
        assert shape.center[2] == pytest.approx(thing.center[2], abs=0.003)
        assert shape.size_m[2] == pytest.approx(size_m[2], abs=0.006)


def test_what_stands_at_the_edge_of_a_table_does_not_reach_to_the_floor():
    bottle = Solid(label="bottle", center=(-0.56, 0.0, 0.87), size_m=(0.07, 0.07, 0.24), cylinder=True)
    rendering, view = view_of([TABLE, bottle, FLOOR], look_at((-1.2, 0.0, 1.4), (-0.5, 0.0, 0.8)), seed=3)
    shape = measure_shape(cloud_of(rendering.ids == 1, view, ProjectionSettings()), view, category_of("bottle"))
    assert shape.size_m[2] == pytest.approx(0.24, abs=0.02)


def test_the_direction_of_a_long_thing_is_measured_up_to_half_a_turn():
    book = Solid(label="book", center=(0.0, 0.0, 0.765), size_m=(0.22, 0.15, 0.03), yaw_rad=2.5)
    rendering, view = view_of([TABLE, book], look_at((-1.0, 0.2, 1.4), (0.0, 0.0, 0.75)), seed=1)
    shape = measure_shape(cloud_of(rendering.ids == 1, view, ProjectionSettings()), view, category_of("book"))
    assert shape.oriented
    assert shape.yaw_rad == pytest.approx(2.5 - np.pi, abs=0.1)


def test_a_mask_that_bleeds_into_the_background_gives_the_same_center():
    bottle = Solid(label="bottle", center=(-0.45, 0.0, 0.87), size_m=(0.07, 0.07, 0.24), cylinder=True)
    rendering, view = view_of([TABLE, bottle], look_at((-1.6, 0.0, 1.1), (-0.4, 0.0, 0.87)), seed=2)
    mask = rendering.ids == 1
    bled = mask | np.roll(mask, 2, axis=1) | np.roll(mask, -2, axis=1) | np.roll(mask, -2, axis=0)
    shape = measure_shape(cloud_of(bled, view, ProjectionSettings()), view, category_of("bottle"))
    assert np.linalg.norm((shape.center - bottle.center)[:2]) < 0.015


def floor_and_wall(points):
    return (points[:, 2] < 0.04) | (points[:, 0] > 0.26)


def test_of_two_cupboards_under_one_mask_the_larger_is_kept_without_the_wall_that_joins_them():
    wide = Solid(label="wardrobe", center=(0.0, 0.0, 0.9), size_m=(0.5, 1.2, 1.8))
    narrow = Solid(label="shelf", center=(0.0, 1.6, 0.7), size_m=(0.4, 0.9, 1.4))
    wall = Solid(label="wall", center=(0.35, 0.8, 1.2), size_m=(0.1, 5.0, 2.4))
    rendering, view = view_of([wide, narrow, wall], look_at((-3.0, 0.6, 1.4), (0.0, 0.6, 0.9)))
    rows, columns = np.nonzero(rendering.ids == 0)
    mask = rendering.ids == 1
    mask[rows.min() : rows.max(), columns.min() - 40 : columns.max() + 40] = True
    cloud = cloud_of(mask, view, ProjectionSettings(), building=floor_and_wall)
    assert cloud.points[:, 1].min() > -0.63
    assert cloud.points[:, 1].max() < 0.63
    assert cloud_of(rendering.ids == 2, view, ProjectionSettings(), building=floor_and_wall) is None


def test_the_floor_between_the_legs_is_no_part_of_a_chair():
    chair = Solid(label="chair", center=(0.0, 0.0, 0.45), size_m=(0.45, 0.45, 0.9))
    floor = Solid(label="floor", center=(0.0, 0.0, -0.05), size_m=(6.0, 6.0, 0.1))
    rendering, view = view_of([chair, floor], look_at((-1.6, 0.0, 1.4), (0.0, 0.0, 0.3)))
    mask = rendering.ids == 0
    mask |= np.roll(mask, 60, axis=1)
    bled = cloud_of(mask, view, ProjectionSettings())
    assert np.abs(bled.points[:, :2]).max() > 0.3
    cloud = cloud_of(mask, view, ProjectionSettings(), building=floor_and_wall)
    assert np.abs(cloud.points[:, :2]).max() < 0.25


def test_a_mask_without_a_name_does_not_make_a_table_larger():
    shelf = Solid(label="shelf", center=(0.2, 0.7, 0.5), size_m=(0.3, 0.5, 1.0))
    rendering, view = view_of([TABLE, shelf], look_at((-2.4, 0.3, 1.4), (0.0, 0.3, 0.6)))
    table = Track(1, "room_1", settings=TrackSettings(), random=np.random.default_rng(0))
    named, nameless = ("table", rendering.ids == 0), ("unknown", rendering.ids >= 0)
    for label, mask in (named, named, named, nameless, nameless):
        instance = Instance(label=label, score=0.9, mask=mask, label_distribution=((label, 0.9),))
        scene = PanopticScene(stamp_s=0.0, instances=(instance,), relations=())
        rgb = np.zeros((*mask.shape, 3), dtype=np.uint8)
        (thing,), _ = detections_of(scene, rgb, view, DetectionSettings(), None, lambda points: points[:, 2] < 0.04)
        table.observe(thing, view, SE3.identity())
    assert table.box.size_m[:2] == pytest.approx(TABLE.size_m[:2], abs=0.06)


def test_holes_and_nonsense_in_depth_are_left_out_and_an_empty_mask_gives_nothing():
    bottle = Solid(label="bottle", center=(-0.4, 0.0, 0.87), size_m=(0.07, 0.07, 0.24), cylinder=True)
    T = look_at((-1.3, 0.0, 1.4), (-0.4, 0.0, 0.8))
    rendering = render([TABLE, bottle], T)
    depth = rendering.depth_m.copy()
    depth[::3] = np.nan
    depth[1::3, ::4] = np.inf
    depth[2::3, ::5] = 0.0
    frame = rgbd_frame(rendering, stamp_s=0.0, T_base_camera=T)
    object.__setattr__(frame, "depth_m", depth)
    view = View.of(frame, room="room_1", T_room_base=SE3.identity(), pose_covariance=np.zeros((6, 6)))
    shape = measure_shape(cloud_of(rendering.ids == 1, view, ProjectionSettings()), view, category_of("bottle"))
    assert np.linalg.norm(shape.center - bottle.center) < 0.02
    assert cloud_of(np.zeros((240, 320), dtype=bool), view, ProjectionSettings()) is None


def test_things_cut_by_the_border_or_hidden_are_told():
    bottle = Solid(label="bottle", center=(-0.4, 0.0, 0.87), size_m=(0.07, 0.07, 0.24), cylinder=True)
    near = Solid(label="box", center=(-0.7, 0.03, 0.9), size_m=(0.02, 0.05, 0.3))
    rendering, view = view_of([TABLE, bottle, near], look_at((-1.5, 0.0, 1.0), (-0.4, 0.0, 0.87)))
    assert cloud_of(rendering.ids == 1, view, ProjectionSettings()).occluded > 0.2
    rendering, view = view_of([TABLE, bottle], look_at((-1.3, 0.0, 1.4), (-0.4, 0.65, 0.8)))
    assert cloud_of(rendering.ids == 1, view, ProjectionSettings()).truncated


def test_covariance_of_a_point_agrees_with_sampled_poses():
    random = np.random.default_rng(4)
    root = np.diag((0.02, 0.03, 0.0, 0.0, 0.0, 0.04))
    base = SE3.from_xyz_yaw(1.0, 2.0, 0.0, 0.6)
    _, view = view_of([TABLE], look_at((1.0, 2.0, 1.4), (3.0, 2.0, 0.5)), T_room_base=base, covariance=root @ root)
    point = np.array((3.0, 2.5, 0.8))
    in_base = base.inverse().apply(point)
    samples = np.array([(base @ SE3.exp(root @ random.standard_normal(6))).apply(in_base) for _ in range(4000)])
    assert point_covariance(view, point) == pytest.approx(np.cov(samples.T), abs=3e-4)


@given(st.floats(-1.5, 1.5), st.floats(0.3, 2.0), st.floats(0.1, 0.29))
def test_the_rectangle_around_a_grid_is_the_grid(yaw_rad, x_m, y_m):
    ticks = np.linspace(-0.5, 0.5, 40)
    local = np.stack(np.meshgrid(ticks * x_m, ticks * y_m), axis=-1).reshape(-1, 2)
    cos, sin = np.cos(yaw_rad), np.sin(yaw_rad)
    rectangle = bounding_rectangle(local @ np.array(((cos, sin), (-sin, cos))) + (3.0, -2.0), align_to_room=False)
    assert (rectangle.center_x_m, rectangle.center_y_m) == pytest.approx((3.0, -2.0), abs=0.03)
    assert rectangle.x_m == pytest.approx(x_m, rel=0.1)
    assert np.sin(rectangle.yaw_rad - yaw_rad) == pytest.approx(0.0, abs=0.12)


def test_furniture_seen_in_parts_from_several_places_gets_its_whole_extent_and_top():
    desk = Solid(label="desk", center=(0.5, -0.3, 0.37), size_m=(1.6, 0.7, 0.74), yaw_rad=0.5)
    belief = SurfaceBelief()
    for k, (eye, target) in enumerate(
        [((-1.0, 0.0, 1.4), (0.0, -0.6, 0.6)), ((-0.6, 0.9, 1.4), (0.9, 0.2, 0.6)), ((1.2, 1.2, 1.4), (1.0, 0.0, 0.6))]
        * 3
    ):
        rendering, view = view_of([desk], look_at(eye, target), seed=k)
        cloud = cloud_of(rendering.ids == 0, view, ProjectionSettings())
        assert cloud.truncated or k % 3
        belief.observe(cloud.points, np.zeros((3, 3)), category_of("desk"), np.array(eye))
    assert np.linalg.norm(belief.box.center - desk.center) < 0.05
    assert belief.box.size_m == pytest.approx(desk.size_m, abs=0.08)
    assert belief.box.yaw_rad == pytest.approx(0.5, abs=0.06)
    assert belief.box.center[2] + belief.box.size_m[2] / 2 == pytest.approx(0.74, abs=0.02)


def test_a_tall_cupboard_of_which_only_the_front_shows_gets_its_usual_depth_away_from_the_camera():
    fridge = Solid(label="fridge", center=(1.0, 0.0, 0.9), size_m=(0.65, 0.65, 1.8))
    belief = SurfaceBelief()
    for k in range(3):
        rendering, view = view_of([fridge], look_at((-1.5, 0.0, 1.4), (1.0, 0.0, 1.0)), seed=k)
        belief.observe(
            cloud_of(rendering.ids == 0, view, ProjectionSettings()).points,
            np.zeros((3, 3)),
            category_of("fridge"),
            np.array((-1.5, 0.0, 1.4)),
        )
    assert np.linalg.norm((belief.box.center - fridge.center)[:2]) < 0.06
