import math

import numpy as np
import pytest

from mashape_cad.evaluation.evaluation import evaluated
from mashape_cad.evaluation.measures import Protocol
from mashape_cad.evaluation.modes import Mode

LABELS = ("a", "a", "b", "b", "alone")
PLACES = np.array([0.0, 2.0, 1.0, 1.9, 50.0])
MODES = (
    Mode("line", ("at",), lambda signatures: np.abs(signatures["at"] - signatures["at"].T)),
    Mode("nonsense", ("at",), lambda signatures: np.zeros((len(signatures["at"]),) * 2)),
    Mode("other", ("at", "of a later release"), lambda _: np.zeros((0, 0))),
)


@pytest.fixture
def found():
    """A set on a line, ranked by where it lies and not at all."""
    return evaluated(LABELS, {"at": PLACES[:, None]}, MODES)


def test_each_mode_is_measured_in_both_protocols(found):
    """In the order in which they are given."""
    assert [(each.mode, each.protocol) for each in found.results] == [
        ("line", Protocol.PAPER),
        ("line", Protocol.PRINCETON),
        ("nonsense", Protocol.PAPER),
        ("nonsense", Protocol.PRINCETON),
    ]


def test_means_of_classes_and_of_all_queries(found):
    """By hand: one of b's members has the other as its nearest, a's members lie apart; who is alone counts nowhere."""
    result = found.result("line", Protocol.PRINCETON)
    assert [(each.label, each.members) for each in result.classes] == [("a", 2), ("alone", 1), ("b", 2)]
    tiers = {each.label: each.means["first_tier"] for each in result.classes}
    assert (tiers["a"], tiers["b"]) == (0.0, 0.5)
    assert math.isnan(tiers["alone"])
    assert result.means["first_tier"] == 0.25
    assert found.result("line", Protocol.PAPER).means["first_tier"] == (2 * 0.5 + 0.5 + 1.0) / 4


def test_a_mode_whose_vectors_are_missing_is_left_out(found):
    """As of sidecars of another release, or of the coarser sampling."""
    assert found.modes == ("line", "nonsense")


def test_orders_and_seconds_of_each_mode_are_kept(found):
    """For the sheets."""
    assert found.orders["line"][0].tolist() == [0, 2, 3, 1, 4]
    assert found.orders["nonsense"][0].tolist() == [0, 2, 3, 4, 1]
    assert set(found.seconds) == {"line", "nonsense"}
    assert min(found.seconds.values()) >= 0
