"""An SSP as another tool might write it: one of ours, edited."""

import re
from zipfile import ZIP_DEFLATED, ZipFile

from orchestrator.case.case import ssp_case

SSD = "SystemStructure.ssd"


def edited(source, target, changes):
    """Copy an archive with texts of its members replaced once each; a pattern is a regular expression."""
    with ZipFile(source) as archive, ZipFile(target, "w", ZIP_DEFLATED) as out:
        for name in archive.namelist():
            content = archive.read(name)
            for old, new in changes.get(name, ()):
                text, count = re.subn(old, lambda _, new=new: new, content.decode(), count=1, flags=re.DOTALL)
                assert count == 1, old
                content = text.encode()
            out.writestr(name, content)
    return target


def real(name, value, unit=""):
    attribute = f' unit="{unit}"' if unit else ""
    return f'<ssv:Parameter name="{name}"><ssv:Real value="{value}"{attribute} /></ssv:Parameter>'


def stated(name):
    return rf'<ssv:Parameter name="{re.escape(name)}">.*?</ssv:Parameter>'


def values_of(path, component):
    with ssp_case(path) as case:
        contents = case.units.contents
        return {c.name: c for c in contents.structure.components}[component].parameters, case.scenario


def with_parameter(small_ssp, tmp_path, component, name, text, units=""):
    changes = [(stated(name), text)]
    if units:
        changes.append(("</ssv:Parameters>", f"</ssv:Parameters><ssv:Units>{units}</ssv:Units>"))
    return edited(small_ssp, tmp_path / "my.ssp", {f"resources/{component}.ssv": changes})
