"""Tables of pandas, which is imported where one is asked for."""

from typing import TYPE_CHECKING, Any

from signorini.exceptions import SceneError

if TYPE_CHECKING:
    from pandas import DataFrame


def as_frame(rows: list[dict[str, Any]]) -> "DataFrame":
    """Rows as a table of pandas.

    Raises
    ------
    SceneError
        If pandas is not installed.

    Examples
    --------
    >>> as_frame([{"n": 4, "l2": 0.5}, {"n": 8, "l2": 0.125}])["l2"].tolist()
    [0.5, 0.125]
    """
    try:
        import pandas as pd
    except ModuleNotFoundError:
        raise SceneError(
            "a table needs pandas; pip install pandas, or signorini[studies]"
        ) from None
    return pd.DataFrame(rows)
