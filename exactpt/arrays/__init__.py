"""First contacts of many small pairs at once, numpy in and out.

`first_contacts` takes bodies that translate, and pairs of them; `point_segment_contacts` bare
queries, moving points against moving segments. Filters in doubles with proved bounds decide most
of them, for all vertices and edges at once; undecided cases are decided exactly, one by one.
So every result equals that of `exactpt.first_contact`, and `Contacts.exact_share` is the fraction
of cases decided exactly.
"""

from exactpt.arrays.contacts import KINDS, Contacts
from exactpt.arrays.pairs import first_contacts
from exactpt.arrays.queries import point_segment_contacts

__all__ = ["KINDS", "Contacts", "first_contacts", "point_segment_contacts"]
