"""The default robot as a URDF: planar base, mast with lift, telescope, wrist, two fingers, pan-tilt head, LiDAR."""

from __future__ import annotations

from dataclasses import dataclass

from simulation.robot.description import RobotDescription


@dataclass(frozen=True, kw_only=True)
class Link:
    """One link: its shapes as URDF fragments, and its mass in kg."""

    name: str
    mass_kg: float
    shapes: tuple[str, ...]
    collides: bool = True


def _box(size: tuple[float, float, float], xyz: tuple[float, float, float]) -> str:
    return f'<origin xyz="{xyz[0]} {xyz[1]} {xyz[2]}"/><geometry><box size="{size[0]} {size[1]} {size[2]}"/></geometry>'


def _cylinder(radius_m: float, length_m: float, z_m: float, x_m: float = 0.0) -> str:
    return f'<origin xyz="{x_m} 0 {z_m}"/><geometry><cylinder radius="{radius_m}" length="{length_m}"/></geometry>'


def _link(link: Link, color: str) -> str:
    visual = "".join(f"<visual>{shape}<material name='{color}'/></visual>" for shape in link.shapes)
    collision = "".join(f"<collision>{shape}</collision>" for shape in link.shapes) if link.collides else ""
    inertia = max(1e-4, 0.01 * link.mass_kg)
    return (
        f'<link name="{link.name}"><inertial><mass value="{link.mass_kg}"/>'
        f'<inertia ixx="{inertia}" iyy="{inertia}" izz="{inertia}" ixy="0" ixz="0" iyz="0"/></inertial>'
        f"{visual}{collision}</link>"
    )


def _joint(name: str, kind: str, parent: str, child: str, xyz: str, axis: str, low: float, high: float) -> str:
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/><origin xyz="{xyz}"/>'
        f'<axis xyz="{axis}"/><limit lower="{low}" upper="{high}" effort="1000" velocity="10"/></joint>'
    )


def robot_urdf(robot: RobotDescription) -> str:
    """The robot's URDF text; joint names are those of ``simulation.robot.robot``."""
    limits, geometry = robot.limits, robot.geometry
    hand, base_m = geometry.hand_length_m, robot.base_height_m
    head = f"{robot.head_x_m} 0 {geometry.camera_height_m}"
    links = [
        (Link(name="world", mass_kg=0.0, shapes=()), "gray"),
        (Link(name="slide_x", mass_kg=1.0, shapes=()), "gray"),
        (Link(name="slide_y", mass_kg=1.0, shapes=()), "gray"),
        (
            Link(
                name="base",
                mass_kg=robot.base_mass_kg,
                shapes=(
                    _cylinder(robot.base_radius_m, base_m, base_m / 2 + robot.base_clearance_m),
                    _box(robot.mast_m, (robot.mast_x_m, 0.0, base_m + robot.mast_m[2] / 2)),
                ),
            ),
            "body",
        ),
        (Link(name="carriage", mass_kg=2.0, shapes=(_box((0.10, 0.08, 0.08), (-0.02, 0.0, 0.0)),)), "dark"),
        (
            Link(name="telescope", mass_kg=1.0, shapes=(_box((0.80, 0.05, 0.05), (-0.42, 0.0, 0.0)),), collides=False),
            "light",
        ),
        (Link(name="wrist", mass_kg=0.3, shapes=(_box((0.06, 0.05, 0.05), (0.03, 0.0, 0.0)),)), "dark"),
        (Link(name="palm", mass_kg=0.3, shapes=(_box((0.04, 0.16, 0.04), (0.08, 0.0, 0.0)),)), "dark"),
    ]
    for side, sign in (("left", 1.0), ("right", -1.0)):
        shape = _box(robot.finger_m, (hand - robot.finger_behind_m, sign * robot.finger_m[1] / 2, 0.0))
        links.append((Link(name=f"finger_{side}", mass_kg=0.1, shapes=(shape,)), "pad"))
    lidar = (_cylinder(0.06, 0.10, 0.0), _box((0.10, 0.06, 0.03), (-0.05, 0.0, -0.07)))
    links += [
        (Link(name="lidar", mass_kg=0.5, shapes=lidar, collides=False), "dark"),
        (Link(name="pan", mass_kg=0.2, shapes=()), "dark"),
        (Link(name="head", mass_kg=0.3, shapes=(_box((0.04, 0.10, 0.04), (-0.01, 0.0, 0.0)),), collides=False), "head"),
    ]
    far = 200.0
    half = limits.gripper_opening_m[1] / 2 + 0.005
    joints = [
        _joint("base_x", "prismatic", "world", "slide_x", "0 0 0", "1 0 0", -far, far),
        _joint("base_y", "prismatic", "slide_x", "slide_y", "0 0 0", "0 1 0", -far, far),
        _joint("base_yaw", "continuous", "slide_y", "base", "0 0 0", "0 0 1", 0, 0),
        _joint("lift", "prismatic", "base", "carriage", "0 0 0", "0 0 1", *limits.lift_m),
        _joint(
            "extension", "prismatic", "carriage", "telescope", f"{geometry.wrist_x_m} 0 0", "1 0 0", *limits.extension_m
        ),
        _joint("wrist_pitch", "revolute", "telescope", "wrist", "0 0 0", "0 -1 0", *limits.wrist_pitch_rad),
        _joint("wrist_roll", "revolute", "wrist", "palm", "0 0 0", "1 0 0", *limits.wrist_roll_rad),
        _joint("finger_left", "prismatic", "palm", "finger_left", "0 0 0", "0 1 0", -0.003, half),
        _joint("finger_right", "prismatic", "palm", "finger_right", "0 0 0", "0 -1 0", -0.003, half),
        _joint("lidar", "fixed", "base", "lidar", f"0 0 {geometry.lidar_height_m}", "0 0 1", 0, 0),
        _joint("pan", "revolute", "base", "pan", head, "0 0 1", *limits.pan_rad),
        _joint("tilt", "revolute", "pan", "head", "0 0 0", "0 -1 0", *limits.tilt_rad),
    ]
    colors = {
        "gray": ".5 .5 .5",
        "body": ".86 .88 .9",
        "dark": ".2 .22 .25",
        "light": ".7 .72 .75",
        "pad": ".15 .15 .15",
        "head": ".1 .1 .12",
    }
    materials = "".join(f'<material name="{name}"><color rgba="{rgb} 1"/></material>' for name, rgb in colors.items())
    return f'<robot name="majordomo">{materials}{"".join(_link(*entry) for entry in links)}{"".join(joints)}</robot>'
