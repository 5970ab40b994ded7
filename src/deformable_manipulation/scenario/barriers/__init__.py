"""The barriers that there are: each module of this package declares one as ``BARRIER``.

The mathematics of a barrier is in the C++ core (``src/control/barriers``), under the same name.
"""

import importlib
import pkgutil
from typing import Dict

from deformable_manipulation.scenario.barriers.kind import BarrierKind


def _declared() -> Dict[str, BarrierKind]:
    modules = [
        importlib.import_module("{}.{}".format(__name__, found.name))
        for found in pkgutil.iter_modules(__path__)
    ]
    kinds = [module.BARRIER for module in modules if hasattr(module, "BARRIER")]
    return {kind.name: kind for kind in sorted(kinds, key=lambda kind: kind.rank)}


#: Every barrier by its name, in the order of their ranks.
BARRIERS = _declared()
