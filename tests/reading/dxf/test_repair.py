from mashape_cad.reading.dxf.repair import Marked, with_decimal_points, with_subclass_markers


def text(*pairs):
    """Write group codes and values as a DXF file does."""
    return ("\n".join(f"{code}\n{value}" for code, value in pairs) + "\n").encode()


ENTITIES = [(0, "SECTION"), (2, "ENTITIES")]
END = [(0, "ENDSEC"), (0, "EOF")]


def test_decimal_commas_become_points_in_coordinates_only():
    """A text with a comma keeps it; whole numbers and points stay as they are."""
    data = text((0, "TEXT"), (1, "1,5"), (10, "1,5"), (20, "-2,25e3"), (30, "7.5"), (40, "3"), (62, "1,2"))
    repaired, count = with_decimal_points(data)
    assert repaired == text((0, "TEXT"), (1, "1,5"), (10, "1.5"), (20, "-2.25e3"), (30, "7.5"), (40, "3"), (62, "1,2"))
    assert count == 2


def test_attributes_are_sorted_under_their_markers():
    """Name and owner, then AcDbEntity with layer and colour, then the entity's own."""
    data = text(*ENTITIES, (0, "SPLINE"), (5, "1F"), (71, 3), (8, "CUT"), (40, "0.0"), (62, 1), (10, "2.0"), *END)
    expected = [(0, "SPLINE"), (5, "1F"), (100, "AcDbEntity"), (8, "CUT"), (62, 1)]
    expected += [(100, "AcDbSpline"), (71, 3), (40, "0.0"), (10, "2.0")]
    assert with_subclass_markers(data) == Marked(text(*ENTITIES, *expected, *END), mended=1, left_out=0)


def test_an_arc_is_a_circle_first():
    """Centre and radius belong to AcDbCircle, the angles to AcDbArc."""
    data = text(*ENTITIES, (0, "ARC"), (8, "0"), (10, "1.0"), (20, "2.0"), (40, "3.0"), (50, "0"), (51, "90"), *END)
    expected = [(0, "ARC"), (100, "AcDbEntity"), (8, "0"), (100, "AcDbCircle"), (10, "1.0"), (20, "2.0"), (40, "3.0")]
    expected += [(100, "AcDbArc"), (50, "0"), (51, "90")]
    assert with_subclass_markers(data).data == text(*ENTITIES, *expected, *END)


def test_what_has_markers_is_kept_and_unknown_kinds_are_counted():
    """A marked entity stays byte for byte; one of unknown classes is left out."""
    marked = [(0, "LINE"), (8, "0"), (100, "AcDbEntity"), (100, "AcDbLine"), (10, "1.0")]
    found = with_subclass_markers(text(*ENTITIES, *marked, (0, "MTEXT"), (1, "A"), *END))
    assert found == Marked(text(*ENTITIES, *marked, *END), mended=0, left_out=1)


def test_the_version_is_raised_and_sections_without_geometry_are_left_out():
    """AC1009 has no markers; OBJECTS may be broken in any way; layers are kept, since they may be hidden."""
    header = [(0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, "AC1009"), (9, "$INSUNITS"), (70, 4), (0, "ENDSEC")]
    layer = [(0, "LAYER"), (2, "OLD"), (70, 1), (62, -7)]
    tables = [(0, "SECTION"), (2, "TABLES"), (0, "TABLE"), (2, "LAYER"), (70, 1), *layer, (0, "ENDTAB"), (0, "ENDSEC")]
    objects = [(0, "SECTION"), (2, "OBJECTS"), (0, "XRECORD"), (0, "ENDSEC")]
    found = with_subclass_markers(text((999, "made by hand"), *header, *tables, *objects, *ENTITIES, *END))
    repaired = found.data
    assert found.is_newer
    assert b"AC1009" not in repaired
    assert b"AC1012" in repaired
    assert b"$INSUNITS" in repaired
    assert b"OBJECTS" not in repaired
    assert text((100, "AcDbLayerTableRecord"), (2, "OLD"), (70, 1), (62, -7)) in repaired
