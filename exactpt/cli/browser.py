"""Results for a scene typed into a page, which runs the package in Pyodide (docs/browser.md).

The page's worker calls `answer` and `picture`; texts go in and JSON comes out.
"""

from __future__ import annotations

import json
import traceback
from collections.abc import Callable

from exactpt.cli.terminal import answer_in_words, print_error
from exactpt.errors import InputError
from exactpt.scene.format import loads
from exactpt.search.first import ContactQuery, search_for


def answer(scene: str, method: str, tiling: str) -> str:
    """Return the first contact of a scene.

    Args:
        scene: the text of a scene file.
        method: as in `exactpt.first_contact`.
        tiling: likewise.

    Returns:
        A JSON object: ``words`` and ``json``, what `exactpt collide` prints without and with
        ``--json``; or ``error``, the line that it prints instead.
    """

    def answered() -> dict[str, str]:
        given = loads(scene)
        search = search_for(given, ContactQuery(method, tiling))
        contact = search.run_to_contact()
        found = {
            "contact": contact and contact.to_json(),
            "until": str(given.exact_end),
            "tiling": search.name,
            "stats": search.stats,
        }
        words = "\n".join(answer_in_words(given, contact))
        return {"words": words, "json": json.dumps(found, indent=1)}

    return _or_error(answered)


def picture(scene: str, tiling: str) -> str:
    """Return the animation of a scene up to its first contact.

    Args:
        scene: the text of a scene file.
        tiling: the tiling that is drawn, as in `exactpt.first_contact`.

    Returns:
        A JSON object: ``page``, what `exactpt draw` writes as an HTML document; or ``error``,
        the line that it prints instead.
    """
    from exactpt.render.film import film_of
    from exactpt.render.page import page_of

    def drawn() -> dict[str, str]:
        return {"page": page_of(film_of(loads(scene), tiling=tiling), title="scene")}

    return _or_error(drawn)


def _or_error(answered: Callable[[], dict[str, str]]) -> str:
    """Return the result of the function as JSON, or the reason of its end in one line."""
    try:
        return json.dumps(answered())
    except InputError as error:
        return json.dumps({"error": f"exactpt: {error}"})
    except Exception as error:
        print_error(*traceback.format_exc().splitlines())
        bug = "this is a bug in exactpt; please report it with the scene"
        return json.dumps({"error": f"exactpt: an invariant broke: {error}; {bug}"})
