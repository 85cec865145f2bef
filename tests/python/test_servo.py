"""The whole loop in simulated time."""

import numpy as np
import pytest

import hapbeam as hb
from conftest import bar, ruler


def pressed_bar():
    device = hb.VirtualPhantom(hb.HandPath((0, 0.02)).press(0.03, 0.5).rest(0.5))
    servo = hb.Servo(hb.FemModel(bar(), 16), device.info, hb.Placement.in_plane((1.27, 0.0177)))
    return device, servo


def test_a_simulated_hand_presses_a_bar_and_comes_to_rest():
    """At rest the coupling's spring carries the force that the beam has there."""
    device, servo = pressed_bar()
    log = device.run(servo, 1)
    assert len(log) == 1000 and (np.diff(log["time"]) > 0).all()
    last = log[-1]
    assert last["pressing"] and hb.LoopStatus(last["status"]) == hb.LoopStatus.touching
    assert np.abs(np.diff(log["force"][-50:, 1])).max() <= 0.05
    gap = last["avatar"][1] - last["hand"][1]
    assert last["force"][1] == pytest.approx(servo.coupling.stiffness * gap, rel=0.02)
    assert not log["pressing"][0]
    record = servo.record
    assert record.ticks == 1000 and record.contact_ticks == log["pressing"].sum()
    assert (record.force == last["force"]).all()
    assert record.max_force == pytest.approx(np.linalg.norm(log["force"], axis=1).max(), rel=1e-12)


def test_the_same_simulation_has_the_same_bits():
    first, second = (device.run(servo, 0.4) for device, servo in (pressed_bar(), pressed_bar()))
    assert first["pressing"].any()
    for field in first.dtype.names:
        assert (first[field] == second[field]).all(), field


def test_a_loop_of_ones_own_is_ticked_with_a_coupling_of_ones_own():
    """The spring of the coupling and the beam are in series."""
    servo = hb.Servo(hb.FemModel(bar(), 16), hb.known_device("omega.3"),
                     hb.Placement.in_plane((1.27, 0.0177)), coupling=hb.CouplingFigures(1000, 2))
    assert servo.coupling.stiffness == 1000
    for k in range(600):
        force = servo.tick((0, min(0.002 * (500 - k) / 500, 0.002), 0), (0, 0, 0), 1e-3)
    record = servo.record
    gap = record.avatar[1] - record.hand[1]
    assert gap > 0 and force[1] == pytest.approx(1000 * gap, rel=0.05)
    assert (record.force == force).all() and record.ticks == 600
    servo.reset()
    assert servo.record.ticks == 0


def test_devices_and_what_they_render():
    info = hb.known_device("omega.3")
    assert info.peak_force == 12
    slow = hb.safe_coupling(info)
    info.period = 0.25e-3
    assert hb.safe_coupling(info).stiffness > slow.stiffness
    with pytest.raises(ValueError, match="device 'nothing': must be one of Touch"):
        hb.known_device("nothing")
    device, servo = pressed_bar()
    with pytest.raises(ValueError, match="duration = -1 s"):
        device.run(servo, -1)


def test_a_hand_turns_the_end_of_a_rod_and_feels_its_torque():
    """At rest the torque is about the rod, and no more than GJ φ/L for the turn of the hand."""
    path = hb.HandPath((0, 0)).rest(0.3).turn((0, 0, 1.0), 1).rest(0.3)
    device = hb.VirtualPhantom(path, gimbal=True)
    rod = hb.Rod(0.4, hb.RodSection.circle(0.002), hb.RodMaterial(3e9, 1.1e9),
                 hb.grip_support(device.info), hb.RodSupport.clamped)
    rod.place_left(hb.RodPose((0, 0, 0), (0, 0, -1), (0, 1, 0)))
    grip = hb.Grip(hb.FemModel(rod, 12), hb.RodSide.left)
    log = device.run(hb.Servo(grip, device.info), path.duration)
    stiffness = 1.1e9 * hb.RodSection.circle(0.002).torsion / 0.4
    torque = log["torque"][-1]
    assert grip.held and log["pressing"][-1]
    assert np.abs(torque[:2]).max() <= 0.05 * abs(torque[2])
    assert 0.5 * stiffness <= abs(torque[2]) <= stiffness
    grip.let_go()
    device.reset()
    assert (device.run(hb.Servo(grip, device.info), 0.5)["torque"] == 0).all()


def test_a_servo_of_a_rod_takes_a_ball():
    wire = hb.Rod(0.2, hb.RodSection.circle(0.002), hb.RodMaterial(200e9, 77e9),
                  hb.RodSupport.clamped, hb.RodSupport.free)
    device = hb.VirtualPhantom(hb.HandPath((0, 0.002)).press(0.01, 0.5))
    servo = hb.Servo(hb.FemModel(wire, 8, hb.Element.RoundRod), device.info,
                     hb.Placement((0.15, 0.011, 0)), avatar_radius=0.01)
    log = device.run(servo, 0.6)
    assert log["force"][-1, 1] > 0.1 and (log["model"] == hb.Status.ok).all()


def test_a_model_of_several_contacts_has_no_servo():
    device = hb.VirtualPhantom(hb.HandPath((0, 0)))
    with pytest.raises(TypeError):
        hb.Servo(hb.FemModel(ruler(), 8, hb.Element.Corotational, 2), device.info)
