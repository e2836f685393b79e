"""Several discs in one picture: Mueller matrices, differences, and the model beside photons."""

import numpy as np
import pytest

import optipath as op
from measured_hemispheres import measured
from pictures import faults_of, texts_of
from tables import rows

figures = pytest.importorskip("matplotlib.figure")


def pixels_of(ax):
    (image,) = ax.get_images()
    return image.get_array()


def test_every_element_of_a_mueller_matrix_has_its_map():
    silver = measured("silver")
    panel = op.plots.mueller_hemisphere(silver, known_to=0.05)
    assert panel.shape == (4, 4)
    over = silver.own.estimate(lambda n: silver.matrices(n) / silver.matrices(n)[..., :1, :1])
    value, error = (each[0, :, :, 0] for each in over)
    for row, column in [(0, 1), (1, 0), (2, 3), (3, 3)]:
        ax, (image,) = panel[row, column], panel[row, column].get_images()
        assert ax.get_title() == f"M{row}{column} / M00"
        assert image.get_clim() == (-1.0, 1.0)
        known = error[:, :, row, column] <= 0.05
        np.testing.assert_array_equal(~image.get_array().mask, known)
        np.testing.assert_array_equal(
            image.get_array().compressed(), value[:, :, row, column][known]
        )
    told = {text.get_text() for text in texts_of(panel[0, 0].figure)}
    assert any("hatched: no light, or not known to 0.05" in text for text in told)


def test_light_with_and_without_polarisation_has_one_scale():
    glass = measured("glass on glass")
    panel = op.plots.differences(glass)
    assert faults_of(panel[0].figure) == []
    limits = [ax.get_images()[0].get_clim() for ax in panel]
    assert limits[0] == limits[1]
    assert limits[2][0] == -limits[2][1]
    area = glass.sensor.solid_angle
    polarised, scalar, apart = map(pixels_of, panel)
    np.testing.assert_allclose(polarised - scalar, apart, rtol=0, atol=1e-12)
    np.testing.assert_allclose((scalar * area).sum(), glass.scalar[0][0].sum(), rtol=1e-12)


def test_the_model_stands_beside_photons_that_are_scattered_once():
    silver = measured("silver", events=1)
    panel = op.plots.beside_facets(silver)
    assert [ax.get_title() for ax in panel[:, 3]] == ["S3, photons", "S3, model", "S3, difference"]
    # Of an unpolarised source nothing that is reflected once is circular (M. Wang et al. 2017).
    assert np.abs(pixels_of(panel[1, 3])).max() < 1e-12
    photons, model, apart = (pixels_of(ax) for ax in panel[:, 0])
    np.testing.assert_allclose(apart, 100.0 * (photons - model) / model.max(), atol=1e-9)
    assert np.abs(apart).mean() < 3.0


def test_panels_are_drawn_into_axes_and_known_to_a_tenth_by_default():
    axes = figures.Figure().subplots(1, 3)
    panel = op.plots.differences(measured("silver"), axes)
    assert [*panel] == [*axes]
    assert axes[0].figure.get_suptitle() == ""
    silver = measured("silver")
    usual, given = (
        op.plots.mueller_hemisphere(silver, known_to=limit)[1, 0] for limit in (None, 0.1)
    )
    np.testing.assert_array_equal(pixels_of(usual).mask, pixels_of(given).mask)


@rows("draw", ["mueller_hemisphere", "differences", "beside_facets"])
def test_axes_of_another_shape_are_refused(draw):
    axes = figures.Figure().subplots(1, 2)
    with pytest.raises(op.OptipathError, match=r"give \d x \d Axes of Matplotlib, as figure.subpl"):
        getattr(op.plots, draw)(measured("silver", events=1), axes)


def test_what_has_not_been_measured_is_told_and_no_model_beside_several_scatterings():
    sample, options = op.load_sample("perfect-reflector-rough"), {"sensor": 16, "photons": 600}
    found = op.measure(sample, "60 deg", polarized="polarized", **options)
    with pytest.raises(op.SurfaceError, match="has not been measured; measure with polarized"):
        op.plots.differences(found)
    with pytest.raises(op.SurfaceError, match="measure with events=1"):
        op.plots.beside_facets(measured("silver"))
