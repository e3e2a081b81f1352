"""What an FMU is made of: the recipe of a unit, and its content, file by file."""

from __future__ import annotations

import json
import os
import uuid
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from datetime import UTC, datetime
from functools import cached_property
from importlib import metadata
from pathlib import Path
from typing import Any

from fmus.build.describe import page
from fmus.build.description import Identity, model_description
from fmus.build.sources import package_folder, source_files
from fmus.port import with_starts
from fmus.port.variable import Value, Variable
from fmus.unit import loader

_NAMESPACE = uuid.UUID("6f0d3f5e-6a5b-5d0c-9d3f-2f6a1c0b7e11")
_BUILDERS = (
    "build/description.py",
    "build/promises.py",
    "build/describe.py",
    "build/recipe.py",
    "build/sources.py",
    "unit/loader.py",
)

_ENTRY = '''"""Entry of the FMU {name}; pythonfmu runs it for each instance."""

from {loader} import keep, unit_class

keep(globals())


class {class_name}(unit_class(__file__, {facade!r}, {facade_class!r}, {packages!r})):
    """{description}"""

    digest = bytes.fromhex({digest!r})

    def __init__(self, **kwargs):
        super().__init__(**{arguments!r}, **kwargs)
'''


@dataclass(frozen=True)
class Recipe:
    """A unit as the builder needs it.

    Attributes
    ----------
    file_name, name, description : str
        Name of the ``.fmu`` file, model identifier, one line.
    facade, facade_class : str
        Module and class of the facade.
    packages : tuple of str
        Packages the facade draws on.
    variables : callable
        Returns the port; may compute start values, and is called only to build.
    arguments : mapping
        Keyword arguments of the facade's class.
    resources : mapping
        Further files in the resources, by name.
    keeps_starts : bool
        Add ``starts.json``, the start values by name, to the resources.
    builder_modules : tuple of str
        Modules that `variables` draws on; they stay outside, but count in the digest.
    starts : mapping
        Start values in place of those of the port, by variable name.
    promises : tuple of str
        See `fmus.build.promises`.
    modules : tuple of str
        Modules that the facade imports by name, which no import statement shows.
    """

    file_name: str
    name: str
    description: str
    facade: str
    facade_class: str
    packages: tuple[str, ...]
    variables: Callable[[], tuple[Variable, ...]]
    arguments: Mapping[str, Any] = field(default_factory=dict)
    resources: Mapping[str, bytes] = field(default_factory=dict)
    keeps_starts: bool = False
    builder_modules: tuple[str, ...] = ()
    starts: Mapping[str, Value] = field(default_factory=dict)
    promises: tuple[str, ...] = ()
    modules: tuple[str, ...] = ()

    @cached_property
    def sources(self) -> dict[str, dict[str, bytes]]:
        """Files of each package; of `fmus` the same for each unit, so that units share it."""
        return source_files((self.facade, *self.modules, "fmus.port"), self.packages)

    @cached_property
    def digest(self) -> str:
        """Digest of all that the FMU is made from, 32 hexadecimal digits."""
        own = package_folder("fmus")
        files = {f"builder/{name}": (own / name).read_bytes() for name in _BUILDERS}
        drawn_on = source_files(self.builder_modules, self.packages)
        for package, sources in (*drawn_on.items(), *self.sources.items()):
            files |= {f"{package}/{name}": content for name, content in sources.items()}
        files |= {f"resources/{name}": content for name, content in self.resources.items()}
        said = (self.file_name, self.name, self.description, self.facade, self.facade_class)
        made_with = (metadata.version("pythonfmu"), version(), dict(self.arguments), dict(self.starts))
        files["recipe"] = json.dumps([said, made_with, self.promises], sort_keys=True).encode()
        return loader.digest_of(files.items())

    @property
    def stored_name(self) -> str:
        """Name of its file in a folder that is shared: it tells apart what the plain name does not."""
        return f"{self.file_name.removesuffix('.fmu')}-{self.digest[:16]}.fmu"

    @property
    def guid(self) -> str:
        """GUID of the FMU: the same for the same content."""
        return str(uuid.uuid5(_NAMESPACE, self.digest))

    def content(self) -> dict[str, bytes]:
        """Return the files of the FMU by their path in the archive."""
        identity = Identity(self.name, self.description, self.guid, version(), _date())
        variables = with_starts(self.variables(), self.starts)
        entry, loader_name = f"{self.name}_{self.digest[:12]}", f"bladeloss_loader_{_loader_digest()}"
        script = _ENTRY.format(
            name=self.name,
            loader=loader_name,
            class_name="".join(word.capitalize() for word in self.name.split("_")),
            facade=self.facade,
            facade_class=self.facade_class,
            packages={package: loader.digest_of(files.items()) for package, files in self.sources.items()},
            description=self.description,
            digest=self.digest,
            arguments=dict(self.arguments),
        )
        files = {
            "modelDescription.xml": model_description(identity, variables, promises=self.promises),
            "documentation/index.html": page(identity, variables),
            "resources/slavemodule.txt": entry.encode(),
            f"resources/{entry}.py": script.encode(),
            f"resources/{loader_name}.py": Path(loader.__file__).read_bytes(),
        }
        if self.keeps_starts:
            starts = {v.name: v.start for v in variables if v.start is not None}
            files["resources/starts.json"] = json.dumps(starts, indent=0).encode()
        for name, content in self.resources.items():
            files[f"resources/{name}"] = content
        for package, sources in self.sources.items():
            for name, content in sources.items():
                files[f"resources/packages/{package}/{name}"] = content
        return files | _pythonfmu_files(self.name)


def version() -> str:
    """Return the version of the distribution."""
    return metadata.version("bladeloss")


def _date() -> str | None:
    """Return the date of the build as far as it is prescribed from outside."""
    epoch = os.environ.get("SOURCE_DATE_EPOCH")
    return datetime.fromtimestamp(int(epoch), UTC).strftime("%Y-%m-%dT%H:%M:%SZ") if epoch else None


def _loader_digest() -> str:
    return loader.digest_of([("loader.py", Path(loader.__file__).read_bytes())])[:12]


def _pythonfmu_files(identifier: str) -> dict[str, bytes]:
    """Return pythonfmu's part: its Python modules, its library per platform, its licence."""
    # not pythonfmu.__file__: once an FMU is loaded, that may be the copy in its resources
    folder = Path(str(metadata.distribution("pythonfmu").locate_file("pythonfmu")))
    files = {f"resources/pythonfmu/{p.name}": p.read_bytes() for p in folder.glob("*.py")}
    binaries = folder / "resources" / "binaries"
    for path in binaries.rglob("*"):
        if path.suffix in (".so", ".dll", ".dylib"):
            platform = path.parent.relative_to(binaries).as_posix()
            files[f"binaries/{platform}/{identifier}{path.suffix}"] = path.read_bytes()
    for file in metadata.files("pythonfmu") or []:
        if file.name == "LICENSE":
            files["documentation/licenses/pythonfmu.txt"] = Path(str(file.locate())).read_bytes()
    return files
