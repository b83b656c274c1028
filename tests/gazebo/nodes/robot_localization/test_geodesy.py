"""UTM and tangent planes against published points."""

import math

import pytest

from trundle.gazebo.nodes.robot_localization.geodesy import (
    TangentPlane,
    UtmZone,
    from_utm,
    parse_zone,
    to_utm,
    zone_of,
)

POINTS = [
    (51.423964, 5.494271, "31U", 673409.989, 5699924.709, 1.950),  # robot_localization's own tests
    (-43.530955, 172.636645, "59G", 632246.802, 5178919.718, -1.127),
    (33.3, 44.4, "38S", 444140.54, 3684706.36, None),  # GeographicLib's example of GeoConvert
]


@pytest.mark.parametrize(("latitude", "longitude", "zone", "easting", "northing", "convergence"), POINTS)
def test_places_are_projected_as_published_and_back(
    latitude: float, longitude: float, zone: str, easting: float, northing: float, convergence: float | None
) -> None:
    found = zone_of(latitude, longitude)
    place = to_utm(latitude, longitude, found)

    assert found == parse_zone(zone)
    assert (place.easting_m, place.northing_m) == pytest.approx((easting, northing), abs=0.01)
    if convergence is not None:
        assert math.degrees(place.convergence) == pytest.approx(convergence, abs=0.001)
    assert from_utm(place.easting_m, place.northing_m, found) == pytest.approx((latitude, longitude), abs=1e-9)


@pytest.mark.parametrize(
    ("latitude", "longitude", "number"),
    [
        (60.0, 5.0, 32),
        (60.0, 2.9, 31),
        (75.0, 8.0, 31),
        (75.0, 9.0, 33),
        (75.0, 21.0, 35),
        (75.0, 41.9, 37),
        (0.0, 180.0, 1),
    ],
)
def test_zones_of_norway_and_svalbard_are_wider(latitude: float, longitude: float, number: int) -> None:
    assert zone_of(latitude, longitude).number == number


def test_the_convergence_is_the_direction_in_which_the_northing_grows() -> None:
    zone = zone_of(48.0, 11.0)
    here, north = to_utm(48.0, 11.0, zone), to_utm(48.00001, 11.0, zone)

    direction = math.atan2(north.easting_m - here.easting_m, north.northing_m - here.northing_m)
    assert direction == pytest.approx(-here.convergence, abs=1e-6)


def test_a_tangent_plane_measures_metres_at_its_origin_and_back() -> None:
    plane = TangentPlane(48.1, 11.6, 520.0)

    east, north, up = plane.forward(48.1 + 1e-5, 11.6 + 1e-5, 523.0)
    assert (east, north, up) == pytest.approx((0.7446, 1.1120, 3.0), abs=1e-3)
    assert plane.reverse(east, north, up) == pytest.approx((48.1 + 1e-5, 11.6 + 1e-5, 523.0), abs=1e-9)
    assert TangentPlane(0.0, 0.0, 0.0).forward(0.0, 0.0, 1.0) == pytest.approx((0.0, 0.0, 1.0))


@pytest.mark.parametrize("text", ["", "17", "61T", "0N", "17I", "T17"])
def test_what_is_no_zone_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match="such as 17T"):
        parse_zone(text)


def test_places_beyond_the_grid_are_refused() -> None:
    with pytest.raises(ValueError, match="from latitude"):
        zone_of(85.0, 0.0)
    with pytest.raises(ValueError, match="from latitude"):
        zone_of(math.nan, 0.0)
    with pytest.raises(ValueError, match="too far from UTM zone 1"):
        to_utm(0.0, 0.0, UtmZone(1, True))
