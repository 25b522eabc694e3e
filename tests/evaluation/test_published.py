import pytest

from mashape_cad.evaluation.published import TABLES, published

LABELS = [name for name in ("airplane", "bird", "bracket", "chassis", "ell", "gear", "map", "rect") for _ in range(10)]


def test_means_of_the_printed_tables():
    """Added up by hand."""
    means = [table.means for table in TABLES]
    assert means[0] == pytest.approx((67.125, 78.5))
    assert means[1] == pytest.approx((72.375, 78.0))
    assert means[2] == pytest.approx((68.0, 79.0))
    assert means[3] == pytest.approx((73.375, 83.25))


def test_misprints_stand_as_printed():
    """A first tier above the second one (reading 22)."""
    assert TABLES[1].tiers["gear"] == (73, 58)
    assert TABLES[3].tiers["ell"] == (71, 88)


def test_they_belong_to_a_set_with_the_papers_classes_only():
    """Eight classes of ten, by their names."""
    assert published(LABELS) == TABLES
    assert published(LABELS[1:]) == ()
    assert published([*LABELS, "bolt"]) == ()
    assert published([label.upper() for label in LABELS]) == ()
