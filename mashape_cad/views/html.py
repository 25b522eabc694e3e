"""HTML pages out of templates: one file each, with their style and pictures inside."""

from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from mashape_cad.views.colours import DARK_AXIS, LIGHT_AXIS
from mashape_cad.views.svg import svg

__all__ = ["html"]


def html(template: str, **values: Any) -> str:
    """Return a page.

    Parameters
    ----------
    template : str
        Name of a file in ``templates``. There, ``drawing | picture`` is a `Drawing` as SVG.
    **values
        What the template names; all text is escaped.
    """
    environment = Environment(
        loader=PackageLoader("mashape_cad.views"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters["picture"] = lambda drawing: Markup(svg(drawing))  # noqa: S704 (`svg` escapes)
    return environment.get_template(template).render(light_axis=LIGHT_AXIS, dark_axis=DARK_AXIS, **values)
