"""What else a plan can be asked: certificates of its intensities, and ways of light one by one."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING, Any, Never

from optipath.plan.choosing import by_place, only
from optipath.plan.plan_texts import PlanTexts
from optipath.values.by_name import check_named

if TYPE_CHECKING:
    from optipath.engines.program.program import Program
    from optipath.plan.certificate import Certificate
    from optipath.plan.light_paths.light_path import LightPath
    from optipath.values.inputs import Inputs


class PlanDetails(PlanTexts):
    """What a plan tells of its light besides the light itself."""

    whole: Program
    inputs: Inputs
    answers: Any

    def certificate(
        self, detector: str | None = None, /, *unnamed: Never, **parameters: Any
    ) -> Certificate:
        """Return how far the intensity at a detector can be from that without polarisation.

        Parameters
        ----------
        detector : str, optional
            Its name; needed only where there are several.
        *unnamed
            None: values are given by name.
        **parameters : float or array_like
            As in `run`.

        Returns
        -------
        Certificate
            Its arrays have the broadcast shape of all values.

        Raises
        ------
        ParameterError
            As in `run`, or if a detector is not named or not known, if light goes round, or
            if a Mueller matrix is unphysical.

        Examples
        --------
        >>> import numpy as np
        >>> import optipath as op
        >>> gold = {"n1": 0.18, "k1": 3.4, "n2": 0.18, "k2": 3.4}
        >>> found = op.load_preset("npgr026").compose().certificate(**gold, phi=[0.2, 1.2])
        >>> print(found.error.round(5))
        [3.00e-05 1.27e-03]
        """
        check_named("certificate", by_place((detector,), unnamed), self.inputs.open)
        ends = tuple(self.whole.readings if detector is not None else self.whole.detectors)
        end = only("detector", ends, "certificate(detector)", detector)
        return self.answers.certificates(parameters)[end]  # type: ignore[no-any-return]

    def paths(
        self,
        /,
        limit: int | None = None,
        bounces: int | None = None,
        *unnamed: Never,
        **parameters: Any,
    ) -> list[LightPath]:
        """Return the ways of light from sources to detectors and dumps, the brightest first.

        The light of all of them together is what `run_all` gives; where light goes round, there
        is no end of them, and with more bounces their sum comes as near as one likes.

        Parameters
        ----------
        limit : int, optional
            How many at most.
        bounces : int, optional
            How often light may be reflected at most on its way.
        *unnamed
            None: values are given by name.
        **parameters : float or array_like
            As in `run`; of a batch, the brightest member counts.

        Returns
        -------
        list of LightPath

        Raises
        ------
        ParameterError
            As in `run`, or if light goes round and nothing says when to stop.

        Examples
        --------
        >>> import optipath as op
        >>> for path in op.load_preset("coated-metal").compose().paths(limit=2):
        ...     print(path)
        0.539067  lamp.out -> surface.transmitted -> metal.reflected -> surface.reflected -> eye
        0.388729  lamp.out -> surface.transmitted -> metal.transmitted -> heat
        """
        from optipath.plan.light_paths.listing import light_paths  # noqa: PLC0415 - not for every import

        given = [value for value in (limit, bounces) if isinstance(value, Mapping)]
        check_named("paths", (*given, *unnamed), self.inputs.open)
        answers = self.answers
        answers.large_angles.look(parameters)
        as_light = partial(answers.as_light, parameters)
        return light_paths(answers.whole, limit, bounces, parameters, as_light)
