"""Scenes: bodies and a closed time span, validated before anything runs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Literal, final, overload

from exactpt.brief import counted
from exactpt.errors import InputError
from exactpt.extensions import extension
from exactpt.filters.rounding import check_rounding
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ, Rational, fraction, rational, rationals, shorten, show
from exactpt.motion.body import Body
from exactpt.motion.outline import is_simple_by_doubles
from exactpt.scene.groups import Groups, groups_given, kept_groups, members_of, names_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from shapely.geometry.base import BaseGeometry

    from exactpt.scene.body_arrays import BodyArrays
    from exactpt.scene.units import Units


@final
class Scene:
    """Bodies that move during a closed time span.

    >>> from exactpt import Body, first_contact
    >>> links = [Body(f"link {k}", [(k, 0), (k + 1, 0)]) for k in range(3)]
    >>> chain = [("link 0", "link 1"), ("link 1", "link 2")]
    >>> first_contact(Scene(links)).kind, first_contact(Scene(links, ignoring=chain))
    ('initial', None)

    Args:
        bodies: the bodies.
        time: the start and the end of the time span.
        ignoring: groups of bodies that ignore each other in every question: each group is a list
            of names and patterns. A text that ends in ``*`` and is not the name of a body is a
            pattern: it means every body whose name starts with the text before the star. A body
            may be in several groups; ignoring is not transitive. A body still counts with itself.

    Attributes:
        bodies: in the order of the file; names are unique. A tuple, or a sequence that makes
            each body on first access (`from_arrays`).
        ignoring: the groups, with their texts as they were given.
        lost: data that `exactpt.read_shapes` left out of the file that it read, such as "crs"
            or "z of 40 points", or `from_shapely` of geometries. Empty for other scenes, also for
            those that are made of this one; it has no part in equality.
        units: the units of lengths and times, or None. Like the epoch they are for people only:
            numbers stay numbers, and nothing is converted.
        epoch: the date of time 0, as the text that was given, or None.

    Args:
        bodies: the bodies, of different names.
        time: the start and the end.
        units: `exactpt.Units`, or a mapping such as ``{"length": "mm", "time": "s"}``.
        epoch: a date with a time and a zone by RFC 3339, such as "2026-01-01T00:00:00Z": UTC
            without leap seconds. It needs a unit of time: "ns", "us", "ms", "s", "min", "h" or
            "day".

    Raises:
        InputError: if a name repeats, the end is not after the start, or a body is not valid at
            the start: a polygon or chain is not simple, holes or parts are where none can be, or
            rings touch of a body that does not keep its shape. Also if a name or pattern of a
            group means no body, or a group has fewer than two bodies; or if the units or the
            epoch are not as above.
        RoundingError: see `check_rounding`.
    """

    __slots__ = (
        "bodies",
        "epoch",
        "exact_end",
        "exact_start",
        "ignoring",
        "kept_rows",
        "lost",
        "units",
    )

    def __init__(
        self,
        bodies: Iterable[Body],
        time: Sequence[Rational] = (0, 1),
        *,
        ignoring: Iterable[Iterable[str]] = (),
        units: Units | Mapping[str, str] | None = None,
        epoch: str | None = None,
    ) -> None:
        check_rounding()
        if isinstance(bodies, Scene):
            raise InputError(
                "bodies: a scene is not a list of bodies, and its groups, units and epoch would be "
                "lost; give scene.bodies"
            )
        self.units, self.epoch = _units_and_epoch(units, epoch)
        self.kept_rows: object = None  # what a search has read: `exactpt.search.reading`
        self.lost: tuple[str, ...] = ()
        self.bodies: Sequence[Body] = tuple(bodies)
        for i, body in enumerate(self.bodies):
            if not isinstance(body, Body):
                raise InputError(f"body {i}: not a body: {shorten(body)}")
        self.exact_start, self.exact_end = _span(time)
        names: set[str] = set()
        for body in self.bodies:
            if body.name in names:
                raise InputError(f"body {shorten(body.name)}: the name is taken by another body")
            names.add(body.name)
            check_valid(body, self.exact_start, self.exact_end)
        self.ignoring: Groups = _checked_groups(ignoring, self.bodies)

    @classmethod
    def from_arrays(
        cls,
        vertices: ArrayLike,
        offsets: ArrayLike,
        *,
        velocities: ArrayLike | None = None,
        coefficients: ArrayLike | None = None,
        closed: ArrayLike = True,
        names: Sequence[str] | None = None,
        radii: ArrayLike = 0.0,
        time: Sequence[Rational] = (0, 1),
        ignoring: Iterable[Iterable[str]] = (),
        units: Units | Mapping[str, str] | None = None,
        epoch: str | None = None,
    ) -> Scene:
        """Return the scene of bodies in numpy arrays, with the exact values of their doubles.

        >>> corners = [(0, 0), (2, 0), (0, 2), (5, 1)]
        >>> scene = Scene.from_arrays(corners, [0, 3, 4], velocities=[(0, 0), (-1, 0)])
        >>> scene.bodies[1]
        <Body '1': point of 1 vertex>

        Polygons and chains are validated at once, in numpy where its bounds allow it. A body,
        and the rationals of its vertices, is made on first access. Arrays state no errors: for
        bodies that have some, make a `Scene` of `Body.with_errors` of these.

        Args:
            vertices: shape (N, 2), the vertices of all bodies.
            offsets: shape (n + 1,): body k has the vertices ``offsets[k]`` to
                ``offsets[k + 1]`` - 1.
            velocities: shape (n, 2); bodies are at rest if neither these nor ``coefficients``
                are given.
            coefficients: shape (n, 2, d + 1): the translation of body k in x and in y is a
                polynomial in t with these coefficients, constant first.
            closed: for each body or for all, False for an open chain.
            names: the names of the bodies; "0", "1", ... if not given.
            radii: for each body or for all, its radius.
            time: the start and the end of the scene.
            ignoring: groups of bodies that ignore each other, see `Scene`.
            units: see `Scene`.
            epoch: see `Scene`.

        Raises:
            InputError: if the arrays do not describe bodies, or the groups are wrong, see `Scene`.
        """
        from exactpt.scene.body_arrays import BodyArrays

        bodies = BodyArrays(
            vertices, offsets, velocities=velocities, coefficients=coefficients, closed=closed,
            names=names, radii=radii,
        )  # fmt: skip
        start, end = _span(time)
        for k in bodies.doubtful():
            check_valid(bodies.make(k), start, end)
        scene = scene_of(bodies, start, end, _checked_groups(ignoring, bodies))
        scene.units, scene.epoch = _units_and_epoch(units, epoch)
        return scene

    @classmethod
    def load(cls, path: str | Path, *, max_bytes: int | None = None) -> Scene:
        """Read a scene from a JSON file in the format of docs/format.md.

        Args:
            path: the file.
            max_bytes: maximum size of the file, which is refused otherwise; by default 10^8.

        Raises:
            InputError: one line that names the file, the body, the key and the value.
        """
        scene: Scene = extension("scene from a file")(Path(path), max_bytes)
        return scene

    def save(self, path: str | Path) -> None:
        """Write the scene as JSON, exactly and atomically: the file is complete or not there.

        Raises:
            InputError: if the file cannot be written, or the scene has a number of more than
                10,000 digits or a custom motion, which files cannot hold.
        """
        from exactpt.scene.written import save

        save(self, Path(path))

    @property
    def start(self) -> Fraction:
        """The first time."""
        return fraction(self.exact_start)

    @property
    def end(self) -> Fraction:
        """The last time, after ``start``."""
        return fraction(self.exact_end)

    @property
    def time(self) -> tuple[Fraction, Fraction]:
        """The first and the last time, as `Scene` takes them."""
        return self.start, self.end

    @classmethod
    def from_json(cls, data: Mapping[str, object]) -> Scene:
        """Return the scene in JSON data, as from `to_json`; see docs/format.md.

        A float counts as the decimal that Python prints for it, as in a file.

        Raises:
            InputError: one line that names the body, the key and the value.
        """
        scene: Scene = extension("scene from JSON")(data)
        return scene

    def to_json(self) -> dict[str, object]:
        """Return the scene as data for ``json.dump``, exact: what `save` writes.

        Raises:
            InputError: see `save`.
        """
        from exactpt.scene.written import to_json

        return to_json(self)

    def body(self, name: str) -> Body:
        """Return the body of this name.

        Raises:
            InputError: if there is none.
        """
        arrays = self._arrays
        if arrays is not None:
            known = arrays.named(name)
            found = None if known is None else arrays[known]
        else:
            found = next((body for body in self.bodies if body.name == name), None)
        if found is not None:
            return found
        raise InputError(f"there is no body {shorten(name)}")

    def __getitem__(self, name: str) -> Body:
        """Return the body of this name.

        Raises:
            KeyError: if there is none.
        """
        try:
            return self.body(name)
        except InputError as error:
            raise KeyError(str(error)) from None

    def __iter__(self) -> Iterator[Body]:
        """Iterate over the bodies."""
        return iter(self.bodies)

    def __contains__(self, name: object) -> bool:
        """Return True if a body has this name."""
        return any(body.name == name for body in self.bodies)

    def __len__(self) -> int:
        """Return the number of bodies."""
        return len(self.bodies)

    def __bool__(self) -> bool:
        """Return True, also without bodies."""
        return True

    @overload
    def at(self, t: Rational) -> dict[str, list[tuple[Fraction, Fraction]]]: ...
    @overload
    def at(
        self, t: Rational | AlgebraicNumber, digits: int
    ) -> dict[str, list[tuple[Decimal, Decimal]]]: ...
    def at(
        self, t: Rational | AlgebraicNumber, digits: int | None = None
    ) -> dict[str, list[tuple[Fraction, Fraction]]] | dict[str, list[tuple[Decimal, Decimal]]]:
        """Return the positions of the vertices of every body at a time, by name; see `Body.at`.

        Args:
            t: the time; without ``digits``, a rational one.
            digits: the number of significant digits of each coordinate.

        Raises:
            InputError: if the time is irrational and no digits are given.
        """
        if digits is None:
            return {body.name: body.at(rational(t)) for body in self.bodies}
        return {body.name: body.at(t, digits) for body in self.bodies}

    @classmethod
    def from_shapely(
        cls,
        geometries: Iterable[BaseGeometry] | Mapping[str, BaseGeometry],
        time: Sequence[Rational] = (0, 1),
        *,
        holes: Literal["keep", "refuse", "fill"] = "keep",
        parts: Literal["keep", "split"] = "keep",
        radius: Rational = 0,
        repair: bool = False,
        skip_invalid: bool = False,
    ) -> Scene:
        """Return the scene of shapely geometries, at rest.

        A MultiPolygon is one body; of other geometries, each part is. Heights, measures and the
        number of a reference system are left out and named in `lost`.

        >>> import shapely
        >>> scene = Scene.from_shapely({"pole": shapely.Point(1, 2, 7)})
        >>> scene.at(0), scene.lost
        ({'pole': [(Fraction(1, 1), Fraction(2, 1))]}, ('z of 1 point',))

        Args:
            geometries: by name, or in order; the exact values of their doubles are taken.
            time: the start and the end of the scene.
            holes: "keep" the holes of polygons, "refuse" such polygons, or "fill" the holes.
            parts: "keep" the parts of a MultiPolygon together as one body, or "split" them.
            radius: the radius of each body.
            repair: whether a polygon that is not valid is replaced by the polygons that its rings
                fill, exactly (see `exactpt.read_shapes`).
            skip_invalid: whether a geometry that cannot be a body is left out; else it is an error.

        Raises:
            InputError: if a geometry cannot be a body (see `exactpt.read_shapes`).
        """
        convert = extension("scene from shapely")
        scene: Scene = convert(
            geometries, time, holes, parts, radius, repair=repair, skip_invalid=skip_invalid
        )
        return scene

    def to_shapely(
        self, t: Rational | AlgebraicNumber, *, tolerance: float | None = None
    ) -> dict[str, BaseGeometry]:
        """Return the bodies at a time as shapely geometries, by name.

        Coordinates are the nearest doubles. A rounded body becomes a polygon of chords, by
        shapely's buffer, which also fills dents shallower than a hundredth of the radius.

        Args:
            t: the time.
            tolerance: maximum distance of a chord from its arc; by default a hundredth of the
                radius.

        Raises:
            InputError: if the time is outside the time span, or the tolerance is not positive.
        """
        convert = extension("scene to shapely")
        geometries: dict[str, BaseGeometry] = convert(self, t, tolerance)
        return geometries

    def until(self, end: Rational) -> Scene:
        """Return the scene up to an earlier end; a later end changes nothing.

        Raises:
            InputError: if the end is not after the start.
        """
        last = min(rational(end), self.exact_end)
        if last <= self.exact_start:
            raise InputError(
                f"the end t = {show(last)} is not after the start t = {show(self.exact_start)}"
            )
        return self._going_on(self.bodies, self.exact_start, last, self.ignoring)

    def since(self, start: Rational) -> Scene:
        """Return the scene from a later start on; an earlier start changes nothing.

        Raises:
            InputError: if the start is not before the end, or a body is not valid at the start.
        """
        first = max(rational(start), self.exact_start)
        if first >= self.exact_end:
            raise InputError(
                f"the start t = {show(first)} is not before the end t = {show(self.exact_end)}"
            )
        for body in self.bodies:
            check_valid(body, first, self.exact_end)
        return self._going_on(self.bodies, first, self.exact_end, self.ignoring)

    def going_on(self, bodies: Iterable[Body], start: QQ) -> Scene:
        """Return the scene from a later start on, at which its bodies are known to be valid.

        Args:
            bodies: the bodies; some may be gone or new. Groups that have lost bodies shrink, and
                new bodies match patterns.
            start: the start.
        """
        present = tuple(bodies)
        groups = self.ignoring
        if groups and present is not self.bodies:
            groups = kept_groups(groups, names_of(self.bodies), names_of(present))
        return self._going_on(present, start, self.exact_end, groups)

    def _going_on(self, bodies: Sequence[Body], start: QQ, end: QQ, ignoring: Groups) -> Scene:
        """Return a scene that is made of this one, with its units and its epoch."""
        scene = scene_of(bodies, start, end, ignoring)
        scene.units, scene.epoch = self.units, self.epoch
        if bodies is self.bodies and self.exact_start <= start and end <= self.exact_end:
            scene.kept_rows = self.kept_rows
        return scene

    @property
    def vertex_count(self) -> int:
        """The number of vertices of all bodies."""
        arrays = self._arrays
        return arrays.vertex_count if arrays is not None else sum(body.size for body in self.bodies)

    @property
    def has_radius(self) -> bool:
        """True if a body has a radius."""
        arrays = self._arrays
        if arrays is not None:
            return bool(arrays.radii.any())
        return any(body.exact_radius for body in self.bodies)

    @property
    def _arrays(self) -> BodyArrays | None:
        """The bodies, if they are in arrays."""
        if isinstance(self.bodies, tuple):
            return None
        from exactpt.scene.body_arrays import BodyArrays

        return self.bodies if isinstance(self.bodies, BodyArrays) else None

    def __eq__(self, other: object) -> bool:
        """Return True if the bodies in order, the spans, groups, units and epochs are equal."""
        if not isinstance(other, Scene):
            return NotImplemented
        return (
            (self.units, self.epoch) == (other.units, other.epoch)
            and (self.exact_start, self.exact_end) == (other.exact_start, other.exact_end)
            and self.ignoring == other.ignoring
            and self.bodies == other.bodies
        )

    def __hash__(self) -> int:
        return hash((self.bodies, self.exact_start, self.exact_end, self.ignoring))

    def __reduce__(self) -> tuple[object, ...]:
        span = str(self.exact_start), str(self.exact_end)
        return _valid_scene, (self.bodies, *span, self.ignoring, self.units, self.epoch)

    def draw(
        self,
        path: str | Path,
        *,
        at: Rational | Literal["contact"] | None = None,
        tiling: str | None = "auto",
        fan: bool = False,
        theme: str = "auto",
        gap: tuple[str, str] | None = None,
        below: Rational | None = None,
        legend: bool = False,
        poses: int = 0,
        seconds: Rational | None = None,
        fps: int | None = None,
    ) -> None:
        """Draw the scene: a picture (.svg, .png), an animation (.html) or a film (.gif, .mp4).

        An animation or film runs from the start to the first contact, or to the end.

        Args:
            path: the file; it is complete or not there.
            at: the time, rational or "contact"; by default the start. An animation shows that
                time first, a film has all times.
            tiling: the tiling to show: "auto" or one of `TILINGS`; None for bodies alone.
            fan: whether the fan triangulation of points is shown too, its edges dashed.
            theme: "light", "dark" or "auto" (the reader's preference; PNG and films: light).
            gap: names of two bodies, whose distance over time is plotted beside an animation; a
                picture is of this plot alone.
            below: a distance >= 0 that is marked in the plot of a picture.
            legend: whether a picture has a scale bar, and the names of bodies beside it.
            poses: number of faint poses of each moving body in a picture, at equal distances in
                time over the whole span, with the path of the mean of its vertices.
            seconds: the length of a film (8), before its last frame stays for a second.
            fps: frames of a film in a second (20).

        Raises:
            InputError: if the suffix is unknown, a library is missing, no contact or body to draw
                exists, or the scene or its tiling has no fan.
            TimeRangeError: if there is nothing to draw at that time.
        """
        when = at if at is None or at == "contact" else rational(at)
        extension("drawing of a scene")(
            self,
            Path(path),
            at=when,
            tiling=tiling,
            fan=fan,
            theme=theme,
            gap=gap,
            below=None if below is None else rational(below),
            legend=legend,
            poses=poses,
            seconds=seconds,
            fps=fps,
        )

    def _repr_html_(self) -> str | None:
        """Return the animation up to the first contact, for notebooks; None if it takes long."""
        player: str | None = extension("player of a scene")(self)
        return player

    def _repr_svg_(self) -> str:
        """Return the bodies at the start as SVG, for notebooks."""
        return str(extension("picture of a scene")(self))

    def __repr__(self) -> str:
        bodies = counted(len(self.bodies), "body")
        vertices = counted(self.vertex_count, "vertex")
        groups = f", {counted(len(self.ignoring), 'ignoring group')}" if self.ignoring else ""
        span = f"[{show(self.exact_start)}, {show(self.exact_end)}]"
        return f"<Scene: {bodies}, {vertices}{groups}, t in {span}>"


def scene_of(bodies: Sequence[Body], start: QQ, end: QQ, ignoring: Groups = ()) -> Scene:
    """Return the scene of bodies, and groups of them, that are known to be valid.

    A search makes scenes of a few bodies that it has chosen: they need no groups.
    """
    scene = Scene.__new__(Scene)
    scene.bodies, scene.exact_start, scene.exact_end = bodies, start, end
    scene.ignoring = ignoring
    scene.lost = ()
    scene.units = scene.epoch = None
    scene.kept_rows = None
    return scene


def a_scene(value: object) -> Scene:
    """Return the value itself, the scene that a question is about.

    Raises:
        InputError: if it is not a scene.
        RoundingError: see `check_rounding`.
    """
    check_rounding()
    if not isinstance(value, Scene):
        raise InputError(f"not a scene: {shorten(value)}")
    return value


def _valid_scene(
    bodies: Sequence[Body],
    start: str,
    end: str,
    ignoring: Groups,
    units: Units | None,
    epoch: str | None,
) -> Scene:
    """Return the scene of a pickle, which was validated before."""
    scene = scene_of(bodies, rational(start), rational(end), ignoring)
    scene.units, scene.epoch = units, epoch
    return scene


def _checked_groups(ignoring: Iterable[Iterable[str]], bodies: Sequence[Body]) -> Groups:
    """Return the groups of a caller, whose names and patterns mean some of the bodies.

    Raises:
        InputError: if one of them means none, or a group has fewer than two bodies.
    """
    groups = groups_given(ignoring)
    if groups:
        members_of(groups, names_of(bodies))
    return groups


def check_valid(body: Body, start: QQ, end: QQ) -> None:
    """Check that a body is valid at the start of a time span: by doubles first.

    Raises:
        InputError: if it is not; see `exactpt.scene.valid`.
    """
    if not is_simple_by_doubles(body, start):
        from exactpt.scene.valid import check_exactly

        check_exactly(body, start, end)


def _units_and_epoch(
    units: Units | Mapping[str, str] | None, epoch: str | None
) -> tuple[Units | None, str | None]:
    """Return the units and the epoch that a caller gives."""
    if units is None and epoch is None:
        return None, None
    from exactpt.scene.units import read_epoch, read_units

    read = read_units(units)
    return read, read_epoch(epoch, read)


def _span(time: Sequence[Rational]) -> tuple[QQ, QQ]:
    start, end = rationals(time, 2, "a time span has a start and an end")
    if start >= end:
        raise InputError(f"time: the span from {show(start)} to {show(end)} is empty")
    return start, end
