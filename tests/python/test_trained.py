"""Trained models: as accurate as they say, and the same from their files."""

import numpy as np
import pytest

import hapbeam as hb
from conftest import DATA, bar

PLAN_DEPTH = 0.05


@pytest.fixture(scope="module")
def trained():
    plan = hb.TrainingPlan.anywhere(bar(), PLAN_DEPTH)
    return {train.__name__: train(bar(), plan, 64) for train in (hb.train_pod, hb.train_galerkin)}


@pytest.mark.parametrize("name", ["train_pod", "train_galerkin"])
def test_no_press_is_farther_from_the_full_model_than_the_bound(trained, name):
    model, full = trained[name], hb.FemModel(bar(), 8)
    random = np.random.default_rng(7)
    s = random.uniform(0.05, 0.95, 500) * model.length
    deepest = np.minimum(PLAN_DEPTH, [model.range().depth_at(x) for x in s])
    d = random.uniform(0.02, 1, 500) * deepest
    forces, statuses = model.presses(s, d)
    exact, _ = full.presses(s, d)
    assert (statuses == hb.Status.ok).all()
    error = np.abs(forces / exact - 1).max()
    assert 0 < error <= model.errors.force_bound <= 1e-3
    assert model.errors.force_median <= model.errors.force_max <= model.errors.force_bound


def test_deeper_than_trained_the_status_says_so(trained):
    assert trained["train_pod"].press(1.27, 0.08).status == hb.Status.out_of_range


def test_a_trained_model_is_touched_as_a_full_one_is(trained):
    hands = np.column_stack([np.full(100, 1.2), np.linspace(0.025, -0.01, 100)])
    fast = hb.Touch(trained["train_pod"], 0.01).ticks(hands)
    full = hb.Touch(hb.FemModel(bar(), 8), 0.01).ticks(hands)
    assert fast.force[-1, 1] == pytest.approx(full.force[-1, 1], rel=1e-3)
    assert np.abs(trained["train_pod"].shape(9) - hb.FemModel(bar(), 8).shape(9)).max() > 1e-3


def test_training_that_makes_no_sense_is_rejected():
    with pytest.raises(ValueError):
        hb.train_pod(bar(), hb.TrainingPlan.anywhere(bar(), -1))
    plan = hb.TrainingPlan.anywhere(bar(), PLAN_DEPTH)
    plan.s_max = 10
    with pytest.raises(ValueError):
        hb.train_pod(bar(), plan)


def test_a_beam_with_a_load_by_python_is_trained_while_threads_call_it():
    loaded = bar().transverse(lambda s: -50.0)
    plan = hb.TrainingPlan.anywhere(loaded, 0.02, 8, 8)
    plan.symmetric = False
    model = hb.train_pod(loaded, plan, 32)
    full = hb.FemModel(bar().transverse(-50.0), 32)
    assert model.press(1.27, 0.01).force == pytest.approx(full.press(1.27, 0.01).force, rel=1e-2)


@pytest.mark.skipif(not hb.has_model_files, reason="built without jansson")
def test_a_model_from_its_file_gives_the_same_bits(trained, tmp_path):
    s, d = np.linspace(0.2, 2.3, 50), np.linspace(-0.04, 0.04, 50)
    for model in trained.values():
        path = str(tmp_path / "model.json")
        hb.save_model(model, path)
        again = hb.load_model(path)
        assert again.kind == model.kind
        model.reset()
        assert (again.presses(s, d)[0] == model.presses(s, d)[0]).all()
        assert again.errors.force_bound == model.errors.force_bound


@pytest.mark.skipif(not hb.has_model_files, reason="built without jansson")
def test_files_of_cpp_are_read_and_broken_ones_rejected(tmp_path):
    assert hb.load_model(str(DATA / "models" / "pod_double.json")).kind == "PodModel"
    assert hb.load_model(str(DATA / "models" / "galerkin_double.json")).kind == "GalerkinModel"
    broken = tmp_path / "broken.json"
    broken.write_text((DATA / "models" / "pod_double.json").read_text().replace("1", "2", 3))
    for path in (broken, tmp_path / "nothing.json",
                 DATA / "models" / "pod_double_force_overflow.json"):
        with pytest.raises(ValueError, match=path.name):
            hb.load_model(str(path))


@pytest.mark.skipif(hb.has_model_files, reason="built with jansson")
def test_without_jansson_a_file_is_a_runtime_error(trained, tmp_path):
    with pytest.raises(RuntimeError, match="HAPBEAM_WITH_JANSSON"):
        hb.save_model(trained["train_pod"], str(tmp_path / "model.json"))
