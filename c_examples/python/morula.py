"""Morula from Python: the shape of a particle as a clump of overlapping spheres.

One file over the C library, with ctypes and numpy; nothing is built. Copy it beside your script.

    import morula
    with morula.Shape.from_file("stone.stl", length_unit=0.001) as shape:
        solid = morula.Solid(shape, cells=64)
        clump = morula.Clump(solid, spheres=50, wants="overlap+moments")
        body = morula.Body(clump, density=2650.0)
        body.write("lammps_rigid", "stone.mol")

The library is found by the environment variable MORULA_LIBRARY, beside this file, or as the system
finds libmorula. Options are keywords named as the fields of the structs in morula.h, where they are
described; constants are numbers (METHOD_BEST) or names ("best"). A failed call raises Error. Handles
free themselves, at the end of a with block or by close() at once.

Spheres are arrays (n, 4): x, y, z, r. Points are (n, 3), triangles (n, 3) from 0, voxels (z, y, x).
Inertia is the six numbers xx, yy, zz, xy, xz, yz; tensor() makes the matrix. Rotations are 3 x 3 with
the body axes as columns, quaternions w, x, y, z. progress is called with the fraction done; where it
returns False the call is cancelled, and what it raises cancels the call and goes on to the caller.
Calls let other Python threads run.
"""

import ctypes
import ctypes.util
import os
import pathlib
import sys
import weakref

import numpy as np

VERSION = (0, 1)

# The three tables below are those of morula.h; test_morula.py compares them.

_CONSTANTS = """
STATUS: OK=0 NULL_POINTER=1 INVALID_ARGUMENT=2 NOT_FINITE=3 INDEX_OUT_OF_RANGE=4 EMPTY=5
  ZERO_VOLUME=6 OPEN_SURFACE=7 SEVERAL_BODIES=8 FORMAT=9 UNSUPPORTED=10 IO=11 MEMORY_LIMIT=12
  OUT_OF_MEMORY=13 BUFFER_TOO_SMALL=14 CANCELLED=15 STRUCT_SIZE=16 TOO_LARGE=17 NOT_WANTED=18
  NO_SPHERES=19 INTERNAL=20 NO_MASSES=21
LOG: INFO=0 WARNING=1
STRUCT: IMPORT_OPTIONS=1 FILE_OPTIONS=2 SOLID_OPTIONS=3 CLUMP_OPTIONS=4 REPORT=5 MOMENTS=6
  OVERLAP=7 SURFACE=8 COUNTERS=9 MASS_OPTIONS=10 MASSES=11 CONTACT_OPTIONS=12 TIMESTEP=13
  EXPORT_OPTIONS=14 BREAK_OPTIONS=15 HELD=16 FRAGMENT=17 BREAK_TOTALS=18 CACHE_COUNTS=19
  COST_OPTIONS=20 COST_POINT=21 COST_BOUNDS=22 SWEEP_OPTIONS=23 SWEPT=24
BODIES: REFUSE=0 LARGEST=1 ALL=2
FORMAT: AUTO=0 STL=1 OBJ=2 PLY=3 OFF=4 NPY=5 TIFF=6 RAW=7
MEANING: AUTO=0 OTSU=1 ABOVE=2 LABEL=3
RAW: U8=0 U16=1 F32=2
CARVE: TOUCHED=0 CENTRES=1
RESOLUTION: CELLS_LONGEST=0 CELLS_SHORTEST=1 CELLS_DIAMETER=2 CELL_SIZE=3
METHOD: MSS=0 BEST=1 SURFACE_FIT=2 INSCRIBED=3 COVER=4 PACKED=5 EUCLIDEAN=10 FERELLEC_MCDOWELL=11
  FAVIER=12 UNIFORM_GRID=13
EFFORT: DRAFT=0 NORMAL=1 THOROUGH=2
LEVELS: FREE=0 CHAINED=1 NESTED=2
GOAL: KNEE=0 SPHERES=1 MISMATCH=2 SECONDS=3 STEP_COST=4 TIME_COST=5
SYMMETRY: NONE=0 AUTO=1 PLANES=2
ENDS: SURFACE=0 CURVE=1
CANDIDATES: THINNED=0 ANALYTIC=1
FRAME: INPUT=0 BODY=1 WORLD=2
CUT: PLANES=0 WITHIN=1 POINTS=2 SEEDED=3 IMPACT=4
WANT: NOTHING=0 OVERLAP=1 SURFACE=2 MOMENTS=4
STOPPED: SPHERES=0 MISMATCH=1 RADIUS=2 DEADLINE=3 CANCELLED=4 EXHAUSTED=5 COVERAGE=6
WARNING: FEWER_SPHERES=1 FAR_AWAY=2 INEXACT_TARGET=3 THIN=4 COARSE_OVERLAP=5 COARSE_DISTANCE=6
TARGET: SOLID=0 UNION=1
OBJECTIVE: EVEN=0 MAX_MIN=1 MAX_LAST=2
INFEASIBLE: REFUSE=0 LEAST_ERROR=1
MASSES: EXACT=0 RELAXED=1 MASS_ONLY=2 NONE=3
EXPORT: MERCURY=0 LAMMPS=1 LAMMPS_RIGID=2 LIGGGHTS=3 YADE=4 DEME=5 MFIX=6 KRATOS=7 PFC=8 EDEM=9
  CSV=10 JSON=11 VTP=12 PLY=13 STL=14
PRECISION: F64=0 F32=1
"""

_STRUCTS = """
import_options: d weld_tolerance, d length_unit, Q memory_limit, i bodies, i index_base, i
  threads, i reserved, p progress, p user
report: Q input_vertices, Q input_faces, Q vertices, Q faces, Q solid_cells, Q components, Q
  bodies, Q bodies_dropped, Q faces_turned, Q boundary_edges, Q nonmanifold_edges, Q
  degenerate_faces, Q duplicate_faces, Q welded_vertices, i watertight, i oriented, i inverted, i
  touches_border, d volume, d area, d box_min[3], d box_max[3], d length_unit, d threshold
moments: d volume, d mass, d centre[3], d inertia[6], d principal[3], d rotation[9], d
  quaternion[4], d relative_error
counters: d seconds_read, d seconds_check, d seconds_solid, d seconds_generate, d
  seconds_measure, d seconds_moments, Q cells, Q peak_bytes, Q transforms, Q exact_distances, Q
  maxima, Q spheres_tried, Q columns
file_options: i format, i meaning, d threshold, I label, i npy_xyz, d spacing[3], d origin[3], Q
  raw_dims[3], Q raw_skip, i raw_type, i reserved
solid_options: i resolution, I cells, d cell_size, Q memory_limit, I padding, i threads, p
  progress, p user
clump_options: Q spheres, d mismatch, d min_radius, d min_distance, d radius_offset, d
  deadline_seconds, Q seed, i method, i confine, i threads, i frame, I wants, I quality_columns,
  p plane_tolerances, z plane_tolerance_count, p progress, p user, i effort, i reserved, d
  coverage, i ends, i candidates, I thinning_cells, I cells_inside, d tolerance, d overlap, d
  overshoot_weight, d max_protrusion, d max_radius, d smoothness, i connected, i equal_volume, i
  symmetry, I symmetry_plane_count, p half_spaces, z half_space_count, p symmetry_planes
overlap: d mismatch, d error_bound, d eta, d iou, d coverage, d overshoot, d target_volume, d
  union_volume, d volume_error, d centroid_error, d moment_errors[3]
surface: d protrusion, d rms_distance, d hausdorff, d distance_bound, d roughness, Q samples, I
  never_exposed, I reserved, d asymmetry, Q symmetry_planes
contact_options: d stiffness, d young, d poisson, d speed, I contacts, I reserved
cost_options: p counts, z count, Q most, d seconds, d density, p contact, d step[3], d lists[2],
  d rebuild, i levels, i surface, i masses, I quality_columns
cost_bounds: Q spheres, d mismatch, d coverage, d surface, d seconds, d step_cost, d time_cost, i
  goal, i reserved
cost_point: Q asked, Q spheres, d mismatch, d coverage, d overshoot, d surface, d hausdorff, d
  protrusion, d roughness, d union_inertia, d inertia, d seconds, d seconds_so_far, d time_step,
  d rayleigh, d step_factor, d least_radius, d step_cost, d time_cost, i masses, i stopped
sweep_options: p resolutions, z resolution_count, p methods, p efforts, z method_count, p
  deadlines, z deadline_count
swept: d resolution, Q cells[3], d solid_seconds, d deadline, Q lines, i method, i effort, i
  status, i cut
mass_options: d density, d m_min, d m_max, i target, i objective, i infeasible, i threads, p
  progress, p user
timestep: d clump, d effective_mass, d stiffness, d rayleigh, d overlap, I sphere, I reserved, d
  together
masses: d mass, d m_min, d largest_m_min, d mass_residual, d centre_residual, d inertia_residual,
  d spread, d union_inertia_error, i status, I binding
export_options: d length, d mass, i placed, I facets, s name, i precision, i reserved
held: d mass, d centre[3], d inertia[6], d scale, d position[3], d quaternion[4], d velocity[3],
  d angular_velocity[3]
cache_counts: Q hits, Q misses, Q evicted, Q parents, Q bytes
break_options: p half_spaces, z half_space_count, p points, p weights, z point_count, p walls, z
  wall_count, Q cells, d point[3], d direction[3], Q seed, d least_volume, Q spheres, d
  min_radius, d gap, d m_min, d deadline_seconds, i kind, i within_union, i precision, i quality,
  i masses, i objective, i infeasible, i threads, p progress, p user
fragment: d mass, d centre[3], d inertia[6], d principal[3], d rotation[9], d position[3], d
  quaternion[4], d velocity[3], d angular_velocity[3], d volume, d coverage, d volume_share, d
  step_factor, d inertia_residual, Q sphere_count, Q map_count, Q half_space_count, Q cell, i
  stopped, i masses
break_totals: d energy, d inertia_error, d shift[3]
"""

_FUNCTIONS = """
I version
s version_string
s status_name i
s last_error_message
z sizeof i
i set_log pp
i import_options_init pz
i shape_from_mesh pzpzpp
v shape_free p
i shape_report pp
i shape_note_count pp
i shape_copy_note pzzpp
i shape_moments pdp
i shape_counters pp
i file_options_init pz
i shape_from_file sppp
i shape_from_bytes pzsppp
i labels_from_file sppzppppp
i labels_from_bytes pzsppzppppp
i shape_from_mask pppppp
i shape_from_grey_u8 ppppppp
i shape_from_grey_u16 ppppppp
i shape_from_grey_f32 ppppppp
i shape_from_label ppppIpp
i labels_count ppp
i labels_copy ppzpppp
i shape_from_silhouettes zppppzipp
s primitive_name z
i primitive_parameter_count sp
i primitive_copy_parameter szzppp
i shape_from_primitive sppzIQpp
i solid_options_init pz
i solid_from_shape ppp
v solid_free p
i solid_grid pppp
i solid_distance pzpp
i solid_note_count pp
i solid_copy_note pzzpp
i solid_moments pdp
i solid_counters pp
i clump_options_init pz
i clump_from_shape pppp
i clump_from_solid ppp
v clump_free p
i clump_sphere_count pp
i clump_copy_spheres pzp
i clump_stopped pp
s stopped_name i
i clump_copy_note pzpp
i clump_warning_count pp
i clump_copy_warnings pzppp
i clump_copy_warning pzzpp
s warning_name i
i clump_moments pdp
i clump_overlap pp
i clump_surface pp
i clump_copy_exposed_areas pzp
i clump_copy_plane_contacts pzp
i clump_counters pp
i clumps_from_solid pppzp
i clumps_from_shapes pzpppp
i clumps_from_labels pppppzppppp
i cost_options_init pz
i cost_bounds_init pz
i cost_curve pppp
i cost_count pp
i cost_cut pp
i cost_copy pzp
i cost_clump pzp
i cost_choose pppzpp
v cost_free p
i sweep_options_init pz
i sweep_from_shape pppppp
i sweep_count pp
i sweep_copy pzp
i sweep_curve pzp
v sweep_free p
i mass_options_init pz
i body_from_clump ppp
i body_from_spheres pzppp
i body_transform pdppdp
i clump_transform ppdppp
i random_orientations Qzp
v body_free p
i contact_options_init pz
i body_timestep ppp
i clump_timestep pppp
i body_sphere_count pp
i body_copy_spheres pizp
i body_copy_spheres_f32 pizp
i body_copy_masses pzp
i body_copy_binding pzp
i body_moments pp
i body_masses pp
s masses_status_name i
i export_options_init pz
i body_write pips
i clump_write ppips
i body_export pipp
i files_count pp
i files_copy_name pzzpp
i files_size pzp
i files_copy_bytes pzzp
v files_free p
i parent_from_solid ppzip
i parent_from_clump ppip
i parent_bytes pp
v parent_free p
i held_init pz
i parent_held pddppppp
i cache_new Qp
i cache_parent ppppzp
i cache_counters pp
i cache_clear p
v cache_free p
i fragments_held pzppppp
i break_options_init pz
i parent_break ppzppp
i parents_break pppppzpp
v fragments_free p
i fragments_from_labels ppppppzppp
i reclump_shape ppzppp
i fragments_count pp
i fragments_dust_count pp
i fragments_get pzp
i fragments_dust pzp
i fragments_totals pp
i fragments_copy_spheres pzizp
i fragments_copy_masses pzzp
i fragments_copy_map pzpzpp
i fragments_copy_half_spaces pzzp
i fragments_shape pzp
i fragments_grow pzdpzdizp
i fragments_note_count pp
i fragments_copy_note pzzpp
i shape_serialize pzpp
i shape_deserialize pzp
i clump_serialize pzpp
i clump_deserialize pzp
i fragments_serialize pzzpp
i fragments_deserialize ppzpp
"""

_C = {"d": ctypes.c_double, "i": ctypes.c_int32, "I": ctypes.c_uint32, "Q": ctypes.c_uint64,
      "z": ctypes.c_size_t, "p": ctypes.c_void_p, "s": ctypes.c_char_p, "v": None}

# Options that take a name of a constant: field -> group.
_NAMED = {"method": "METHOD", "effort": "EFFORT", "frame": "FRAME", "symmetry": "SYMMETRY",
          "ends": "ENDS", "candidates": "CANDIDATES", "resolution": "RESOLUTION", "bodies": "BODIES",
          "format": "FORMAT", "meaning": "MEANING", "raw_type": "RAW", "levels": "LEVELS",
          "goal": "GOAL", "target": "TARGET", "objective": "OBJECTIVE", "infeasible": "INFEASIBLE",
          "precision": "PRECISION", "kind": "CUT", "wants": "WANT", "carve": "CARVE"}

# Options that are arrays: field -> (type, numbers each, the field of their count).
_ARRAYS = {"plane_tolerances": (np.float64, 1, "plane_tolerance_count"),
           "half_spaces": (np.float64, 4, "half_space_count"),
           "symmetry_planes": (np.float64, 3, "symmetry_plane_count"),
           "points": (np.float64, 3, "point_count"), "weights": (np.float64, 1, "point_count"),
           "walls": (np.float64, 4, "wall_count"), "counts": (np.uint64, 1, "count"),
           "resolutions": (np.float64, 1, "resolution_count"),
           "methods": (np.int32, 1, "method_count"), "efforts": (np.int32, 1, "method_count"),
           "deadlines": (np.float64, 1, "deadline_count")}

_ids = {}  # group -> {name: number}


def _read_tables():
    group = None
    for word in _CONSTANTS.split():
        if word.endswith(":"):
            group = word[:-1]
            continue
        name, value = word.split("=")
        globals()[group + "_" + name] = int(value)
        _ids.setdefault(group, {})[name] = int(value)
    structs, name = {}, None
    for line in " ".join(_STRUCTS.split()).replace(": ", ":\n").split("\n"):
        # Each line holds the fields of one struct and, but the last, the name of the next.
        fields, _, after = line.rpartition(" ") if line.endswith(":") else (line, "", "")
        if name:
            members = [("struct_size", ctypes.c_size_t)]
            for field in fields.split(", "):
                letter, _, member = field.partition(" ")
                member, _, length = member.rstrip("]").partition("[")
                members.append((member, _C[letter] * int(length) if length else _C[letter]))
            structs[name] = type(name, (ctypes.Structure,), {"_fields_": members})
        name = after[:-1]
    return structs


def _load():
    here = pathlib.Path(__file__).resolve().parent
    ends = {"darwin": "dylib", "win32": "dll"}.get(sys.platform, "so")
    prefix = "" if sys.platform == "win32" else "lib"
    asked = os.environ.get("MORULA_LIBRARY")
    names = [asked] if asked else [
        str(p) for p in (here / f"{prefix}morula.{ends}",) if p.exists()] + [
        n for n in (ctypes.util.find_library("morula"), f"{prefix}morula.{ends}.0") if n]
    why = ""
    for name in names:
        try:
            return ctypes.CDLL(name)
        except OSError as error:
            why = str(error)
    raise ImportError(f"the library of Morula is not found: set MORULA_LIBRARY to its file ({why})")


_structs = _read_tables()
_library = _load()


def _bind(library):
    functions = {}
    for line in _FUNCTIONS.split("\n"):
        if not line:
            continue
        words = line.split()
        function = getattr(library, "morula_" + words[1])
        function.restype = _C[words[0]]
        function.argtypes = [_C[letter] for letter in (words[2] if len(words) > 2 else "")]
        functions[words[1]] = function
    return functions


_functions = _bind(_library)
_ProgressType = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_double, ctypes.c_void_p)
_LogType = ctypes.CFUNCTYPE(None, ctypes.c_int32, ctypes.c_char_p, ctypes.c_void_p)

if _functions["version"]() // 1000 != 1000 * VERSION[0] + VERSION[1]:
    raise ImportError("morula.py is for version %d.%d of the library, not for " % VERSION
                      + _functions["version_string"]().decode())


class Error(Exception):
    """A call failed: status (one of STATUS_*), its name, and the library's sentence."""

    def __init__(self, status, message):
        super().__init__(message)
        self.status = status
        self.name = _functions["status_name"](status).decode()
        self.message = message


def _call(name, *arguments):
    """Calls a function that gives a status; the message is of this thread."""
    status = _functions[name](*arguments)
    if status:
        raise Error(status, _functions["last_error_message"]().decode("utf-8", "replace"))


def version():
    """The version of the library."""
    return _functions["version_string"]().decode()


class Record:
    """What a struct of the library holds: fields as attributes, arrays as numpy arrays."""

    def __init__(self, struct):
        for name, kind in struct._fields_[1:]:
            if name == "reserved":
                continue
            value = getattr(struct, name)
            if hasattr(kind, "_length_"):
                value = np.array(value)
                if name == "rotation":
                    value = value.reshape(3, 3).T.copy()
            setattr(self, name, value)

    def __repr__(self):
        return "\n".join(f"{k} = {v}" for k, v in vars(self).items())


def _filled(struct, name, *arguments):
    """The struct that a function fills, its last argument, as a Record."""
    value = _structs[struct](struct_size=ctypes.sizeof(_structs[struct]))
    _call(name, *arguments, ctypes.byref(value))
    return Record(value)


def constant(group, value):
    """The number of a constant: itself, or that of a name ("best"), or of several ("overlap+moments")."""
    if not isinstance(value, str):
        return value
    total = 0
    for word in value.split("+"):
        known = _ids[group]
        if word.strip().upper() not in known:
            raise ValueError(f"{word!r} is none of {', '.join(known).lower()}")
        total |= known[word.strip().upper()]
    return total


def _array(value, dtype, shape=None, what="the array"):
    """A contiguous array of this type; `shape` may hold None for any length."""
    array = np.ascontiguousarray(value, dtype=dtype)
    if shape is not None and (array.ndim != len(shape) or any(
            n is not None and n != m for n, m in zip(shape, array.shape))):
        wanted = ", ".join("n" if n is None else str(n) for n in shape)
        raise ValueError(f"{what} must be of shape ({wanted}), not {array.shape}")
    return array


class _Options:
    """A struct of options for the time of a call, with what it points to and what it calls."""

    def __init__(self, struct, values):
        self.struct = _structs[struct]()
        self.kept, self.raised, self.progress = [], None, values.get("progress")
        _call(struct + "_init", ctypes.byref(self.struct), ctypes.sizeof(self.struct))
        fields = {name: kind for name, kind in self.struct._fields_}
        for name, value in values.items():
            if name not in fields or name in ("struct_size", "reserved", "user"):
                raise TypeError(f"morula_{struct} has no option {name!r}")
            if value is not None:
                self._set(name, fields[name], value)

    def _set(self, name, kind, value):
        if name == "progress":
            value = self._keep(_ProgressType(self._tick))
            self.struct.progress = ctypes.cast(value, ctypes.c_void_p)
        elif name == "contact":
            inner = self._keep(_Options("contact_options", value))
            self.struct.contact = ctypes.cast(ctypes.pointer(inner.struct), ctypes.c_void_p)
        elif kind is ctypes.c_void_p:
            dtype, each, count = _ARRAYS[name]
            array = self._keep(_array(value, dtype, (None, each) if each > 1 else (None,), name))
            if name == "weights" and len(array) != self.struct.point_count:
                raise ValueError("one weight for each point, after the points")
            if name == "efforts" and len(array) != self.struct.method_count:
                raise ValueError("one effort for each method, after the methods")
            setattr(self.struct, name, array.ctypes.data)
            setattr(self.struct, count, len(array))
        elif kind is ctypes.c_char_p:
            self.struct.name = self._keep(os.fsencode(value))
        elif hasattr(kind, "_length_"):
            setattr(self.struct, name, kind(*np.ravel(value)))
        else:
            setattr(self.struct, name, constant(_NAMED.get(name), value))

    def _keep(self, value):
        self.kept.append(value)
        return value

    def _tick(self, fraction, _user):
        try:
            return 1 if self.progress(fraction) is False else 0
        except BaseException as error:  # goes on to the caller when the library has returned
            self.raised = error
            return 1

    @property
    def _as_parameter_(self):
        return ctypes.addressof(self.struct)


class _Handle:
    """A handle of the library; close(), a with block or the garbage collector free it."""

    def _own(self, pointer):
        free = _functions[self._noun + "_free"]
        self._pointer = pointer
        self._finalizer = weakref.finalize(self, free, ctypes.c_void_p(pointer))
        return self

    @classmethod
    def _wrap(cls, pointer):
        return cls.__new__(cls)._own(pointer)

    def _make(self, name, options, *arguments):
        """Runs a call that makes this handle, its last argument."""
        out = ctypes.c_void_p()
        try:
            _call(name, *arguments, ctypes.byref(out))
        except Error:
            if options is not None and options.raised is not None:
                raise options.raised from None
            raise
        self._own(out.value)
        if options is not None and options.raised is not None:
            self.close()
            raise options.raised
        return self

    @property
    def _as_parameter_(self):
        if self._pointer is None:
            raise ValueError(f"this {type(self).__name__} is closed")
        return self._pointer

    def close(self):
        """Frees it now; it may not be used any more."""
        self._pointer = None
        self._finalizer()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def _number(self, name, kind, *arguments):
        value = kind()
        _call(name, self, *arguments, ctypes.byref(value))
        return value.value

    def _copy(self, name, shape, dtype=np.float64, before=()):
        """The array that `name` copies; its first axis is the capacity."""
        out = np.empty(shape, dtype=dtype)
        _call(name, self, *before, out.shape[0], out.ctypes)
        return out

    def _text(self, name, *before):
        return _text(lambda *to: _call(name, self, *before, *to))

    def _texts(self, noun):
        count = self._number(noun + "_count", ctypes.c_size_t)
        return [self._text(noun.rpartition("_")[0] + "_copy_" + noun.rpartition("_")[2], i)
                for i in range(count)]

    def _bytes(self, name, *before):
        size = ctypes.c_size_t()
        _call(name, self, *before, 0, None, ctypes.byref(size))
        out = ctypes.create_string_buffer(size.value)
        _call(name, self, *before, size.value, out, ctypes.byref(size))
        return out.raw

    def _counters(self, noun):
        return _filled("counters", noun + "_counters", self)


def _text(copy):
    length = ctypes.c_size_t()
    copy(0, None, ctypes.byref(length))
    out = ctypes.create_string_buffer(length.value + 1)
    copy(len(out), out, None)
    return out.value.decode()


def _grid(cells, spacing, origin):
    """dims, spacing and origin as the library takes them, of an array (z, y, x)."""
    if cells.ndim != 3:
        raise ValueError(f"voxels are an array (z, y, x), not one of {cells.ndim} axes")
    dims = (ctypes.c_size_t * 3)(*reversed(cells.shape))
    return dims, _three(spacing), _three(origin)


def _three(value):
    return (ctypes.c_double * 3)(*np.broadcast_to(np.asarray(value, dtype=np.float64), 3))


def _numbers(value, count):
    return None if value is None else (ctypes.c_double * count)(*np.ravel(value))


def _path(path):
    return os.fspath(path).encode("utf-8")


def _split(values, struct):
    """Takes from keywords those that are options of a struct."""
    own = {name for name, _ in _structs[struct]._fields_}
    return {name: values.pop(name) for name in list(values) if name in own}


class Shape(_Handle):
    """A checked shape: something with an inside. Keywords are those of morula_import_options."""

    _noun = "shape"

    @classmethod
    def _new(cls, name, options, *arguments):
        return cls.__new__(cls)._make(name, options, *arguments)

    @classmethod
    def from_mesh(cls, vertices, triangles, **options):
        options = _Options("import_options", options)
        vertices = _array(vertices, np.float64, (None, 3), "vertices")
        triangles = _array(triangles, np.uint32, (None, 3), "triangles")
        return cls._new("shape_from_mesh", options, vertices.ctypes, len(vertices),
                        triangles.ctypes, len(triangles), options)

    @classmethod
    def from_file(cls, path, **options):
        """Keywords are also those of morula_file_options (format, meaning, label, spacing …)."""
        file = _Options("file_options", _split(options, "file_options"))
        options = _Options("import_options", options)
        return cls._new("shape_from_file", options, _path(path), options, file)

    @classmethod
    def from_bytes(cls, data, name="", **options):
        """Of the bytes of a file; `name` helps where they do not tell the format."""
        file = _Options("file_options", _split(options, "file_options"))
        options = _Options("import_options", options)
        return cls._new("shape_from_bytes", options, bytes(data), len(data), name.encode(),
                        options, file)

    @classmethod
    def from_mask(cls, mask, spacing=1.0, origin=0.0, **options):
        """Of voxels (z, y, x): those that are not 0 are solid."""
        options = _Options("import_options", options)
        mask = np.ascontiguousarray(np.asarray(mask) != 0, dtype=np.uint8)
        return cls._new("shape_from_mask", options, mask.ctypes, *_grid(mask, spacing, origin),
                        options)

    @classmethod
    def from_grey(cls, values, threshold=None, spacing=1.0, origin=0.0, **options):
        """Of grey values (z, y, x), uint8, uint16 or float32; without a threshold Otsu's is taken."""
        options = _Options("import_options", options)
        values = np.ascontiguousarray(values)
        kind = {"uint8": "u8", "uint16": "u16", "float32": "f32"}.get(values.dtype.name)
        if kind is None:
            raise TypeError(f"grey values are uint8, uint16 or float32, not {values.dtype}")
        return cls._new("shape_from_grey_" + kind, options, values.ctypes,
                        *_grid(values, spacing, origin), _numbers(threshold, 1), options)

    @classmethod
    def from_label(cls, labels, label, spacing=1.0, origin=0.0, **options):
        """Of one label of a label volume (z, y, x)."""
        options = _Options("import_options", options)
        labels = _array(labels, np.uint32)
        return cls._new("shape_from_label", options, labels.ctypes,
                        *_grid(labels, spacing, origin), label, options)

    @classmethod
    def from_silhouettes(cls, silhouettes, cells=64, carve="touched", **options):
        """Of pairs (mask, camera): a mask (height, width) and the 3 x 4 camera matrix."""
        options = _Options("import_options", options)
        masks = [np.ascontiguousarray(np.asarray(m) != 0, dtype=np.uint8) for m, _ in silhouettes]
        cameras = _array([np.reshape(c, 12) for _, c in silhouettes], np.float64, (None, 12))
        widths = np.array([m.shape[1] for m in masks], dtype=np.uintp)
        heights = np.array([m.shape[0] for m in masks], dtype=np.uintp)
        pixels = np.concatenate([m.ravel() for m in masks])
        return cls._new("shape_from_silhouettes", options, len(masks), pixels.ctypes,
                        widths.ctypes, heights.ctypes, cameras.ctypes, cells,
                        constant("CARVE", carve), options)

    @classmethod
    def from_primitive(cls, name, parameters=None, segments=0, seed=0, **options):
        """A built-in analytic particle, with parameters as {"radius": 2.0}; see primitives()."""
        options = _Options("import_options", options)
        parameters = parameters or {}
        keys = (ctypes.c_char_p * len(parameters))(*(k.encode() for k in parameters))
        values = _array(list(parameters.values()), np.float64)
        return cls._new("shape_from_primitive", options, name.encode(), keys, values.ctypes,
                        len(parameters), segments, seed, options)

    @classmethod
    def deserialize(cls, data):
        return cls._new("shape_deserialize", None, bytes(data), len(data))

    def serialize(self):
        return self._bytes("shape_serialize")

    def report(self):
        return _filled("report", "shape_report", self)

    def notes(self):
        return self._texts("shape_note")

    def moments(self, density=1.0):
        return _filled("moments", "shape_moments", self, density)

    def counters(self):
        return self._counters("shape")


class Solid(_Handle):
    """A shape with a grid. Keywords are those of morula_solid_options."""

    _noun = "solid"

    def __init__(self, shape, **options):
        options = _Options("solid_options", options)
        self._make("solid_from_shape", options, shape, options)

    def grid(self):
        """Cells, edge lengths and lower corner, each along x, y, z."""
        dims = np.empty(3, dtype=np.uintp)
        spacing, origin = np.empty(3), np.empty(3)
        _call("solid_grid", self, dims.ctypes, spacing.ctypes, origin.ctypes)
        return dims, spacing, origin

    def distance(self, points):
        """Exact signed distances of points (n, 3), negative inside."""
        points = _array(points, np.float64, (None, 3), "points")
        out = np.empty(len(points))
        _call("solid_distance", self, len(points), points.ctypes, out.ctypes)
        return out

    def notes(self):
        return self._texts("solid_note")

    def moments(self, density=1.0):
        return _filled("moments", "solid_moments", self, density)

    def counters(self):
        return self._counters("solid")


class Clump(_Handle):
    """A clump of a solid, or of a shape on a grid of `solid` (a dict of morula_solid_options).

    Keywords are those of morula_clump_options.
    """

    _noun = "clump"

    def __init__(self, of, solid=None, **options):
        options = _Options("clump_options", options)
        if isinstance(of, Solid):
            if solid is not None:
                raise TypeError("a solid has its grid")
            self._make("clump_from_solid", options, of, options)
        else:
            grid = _Options("solid_options", solid or {})
            self._make("clump_from_shape", options, of, grid, options)

    @classmethod
    def _many(cls, name, count, options, *arguments, statuses=()):
        out = (ctypes.c_void_p * count)()
        try:
            _call(name, *arguments, out, *statuses)
        except Error:
            if options.raised is not None:
                raise options.raised from None
            raise
        clumps = [cls._wrap(pointer) for pointer in out]
        if options.raised is not None:
            raise options.raised
        return clumps

    @classmethod
    def levels(cls, solid, spheres, **options):
        """A clump with each of these numbers of spheres."""
        options = _Options("clump_options", options)
        counts = _array(spheres, np.uint64, (None,), "spheres")
        return cls._many("clumps_from_solid", len(counts), options, solid, options, counts.ctypes,
                         len(counts))

    @classmethod
    def of_shapes(cls, shapes, solid=None, **options):
        """A clump of each shape, which threads share; raises for the first that fails."""
        options = _Options("clump_options", options)
        grid = _Options("solid_options", solid or {})
        handles = (ctypes.c_void_p * len(shapes))(*(s._as_parameter_ for s in shapes))
        return cls._many("clumps_from_shapes", len(shapes), options, handles, len(shapes), grid,
                         options, statuses=(None,))

    @classmethod
    def of_labels(cls, labels, wanted, spacing=1.0, origin=0.0, shape=None, solid=None, **options):
        """A clump of each of these labels of a volume (z, y, x), which threads share."""
        options = _Options("clump_options", options)
        grid = _Options("solid_options", solid or {})
        checks = _Options("import_options", shape or {})
        labels = _array(labels, np.uint32)
        wanted = _array(wanted, np.uint32, (None,), "wanted")
        return cls._many("clumps_from_labels", len(wanted), options, labels.ctypes,
                         *_grid(labels, spacing, origin), wanted.ctypes, len(wanted), checks, grid,
                         options, statuses=(None,))

    @classmethod
    def deserialize(cls, data):
        return cls.__new__(cls)._make("clump_deserialize", None, bytes(data), len(data))

    def serialize(self):
        return self._bytes("clump_serialize")

    def __len__(self):
        return self._number("clump_sphere_count", ctypes.c_size_t)

    def spheres(self):
        """In the frame that the options asked for."""
        return self._copy("clump_copy_spheres", (len(self), 4))

    def stopped(self):
        """Why there are no more spheres, for instance "spheres reached"."""
        return _functions["stopped_name"](self._number("clump_stopped", ctypes.c_int32)).decode()

    def note(self):
        return self._text("clump_copy_note")

    def warnings(self):
        """The limits that it meets: of each the name, the figure found, the bound that it misses, a
        sentence."""
        n = self._number("clump_warning_count", ctypes.c_size_t)
        codes, found = np.empty(n, dtype=np.int32), np.empty((2, n))
        _call("clump_copy_warnings", self, n, codes.ctypes, found[0].ctypes, found[1].ctypes)
        return [(_functions["warning_name"](int(codes[i])).decode(), found[0, i], found[1, i],
                 self._text("clump_copy_warning", i)) for i in range(n)]

    def moments(self, density=1.0):
        return _filled("moments", "clump_moments", self, density)

    def overlap(self):
        return _filled("overlap", "clump_overlap", self)

    def surface(self):
        return _filled("surface", "clump_surface", self)

    def exposed_areas(self):
        return self._copy("clump_copy_exposed_areas", (len(self),))

    def plane_contacts(self, count):
        """Most spheres that one plane touches, for each of the `count` plane_tolerances."""
        return self._copy("clump_copy_plane_contacts", (count,), np.uint32)

    def counters(self):
        return self._counters("clump")

    def timestep(self, masses=None, **contact):
        """The time step that it allows; keywords are those of morula_contact_options."""
        masses, contact = _Options("mass_options", masses or {}), _Options("contact_options", contact)
        return _filled("timestep", "clump_timestep", self, masses, contact)

    def write(self, format, path, masses=None, **options):
        """Weighs it (a dict of morula_mass_options) and writes it, as Body.write()."""
        masses = _Options("mass_options", masses or {})
        options = _Options("export_options", options)
        _call("clump_write", self, masses, constant("EXPORT", format), options, _path(path))

    def placed(self, scale=1.0, position=None, quaternion=None, masses=None):
        """Weighs it and sets the body in a size, place and orientation."""
        masses = _Options("mass_options", masses or {})
        return Body.__new__(Body)._make("clump_transform", masses, self, masses, scale,
                                        _numbers(position, 3), _numbers(quaternion, 4))


class Body(_Handle):
    """A weighed clump, or weighed spheres (n, 4) in the frame of `solid` (None: their union).

    Keywords are those of morula_mass_options.
    """

    _noun = "body"

    def __init__(self, of, solid=None, **options):
        options = _Options("mass_options", options)
        if isinstance(of, Clump):
            self._make("body_from_clump", options, of, options)
        else:
            spheres = _array(of, np.float64, (None, 4), "spheres")
            self._make("body_from_spheres", options, spheres.ctypes, len(spheres), solid, options)

    def __len__(self):
        return self._number("body_sphere_count", ctypes.c_size_t)

    def spheres(self, frame="input"):
        return self._copy("body_copy_spheres", (len(self), 4), before=(constant("FRAME", frame),))

    def spheres_f32(self, frame="body"):
        """For codes of single precision, each within the sphere that it stands for."""
        return self._copy("body_copy_spheres_f32", (len(self), 4), np.float32,
                          (constant("FRAME", frame),))

    def masses(self):
        return self._copy("body_copy_masses", (len(self),))

    def result(self):
        """How far the masses add up to the body."""
        return _filled("masses", "body_masses", self)

    def status(self):
        """How far they do, in words."""
        return _functions["masses_status_name"](self.result().status).decode()

    def binding(self):
        """The spheres whose mass is m_min or m_max."""
        return self._copy("body_copy_binding", (self.result().binding,), np.uint32)

    def moments(self):
        return _filled("moments", "body_moments", self)

    def timestep(self, **contact):
        contact = _Options("contact_options", contact)
        return _filled("timestep", "body_timestep", self, contact)

    def transform(self, scale=1.0, position=None, quaternion=None, density=0.0):
        """The same body in another size, place, orientation and density (0: its own)."""
        return Body.__new__(Body)._make("body_transform", None, self, scale,
                                        _numbers(position, 3), _numbers(quaternion, 4), density)

    def write(self, format, path, **options):
        """Writes the file or files of a format ("lammps"); keywords of morula_export_options."""
        options = _Options("export_options", options)
        _call("body_write", self, constant("EXPORT", format), options, _path(path))

    def files(self, format, **options):
        """The same in memory: a dict of what each name adds to the path, and the bytes."""
        options = _Options("export_options", options)
        with _Files.__new__(_Files)._make("body_export", None, self, constant("EXPORT", format),
                                          options) as files:
            return files.all()


class _Files(_Handle):
    _noun = "files"

    def all(self):
        found = {}
        for i in range(self._number("files_count", ctypes.c_size_t)):
            size = ctypes.c_size_t()
            _call("files_size", self, i, ctypes.byref(size))
            out = ctypes.create_string_buffer(size.value)
            _call("files_copy_bytes", self, i, size.value, out)
            found[self._text("files_copy_name", i)] = out.raw
        return found


class Parent(_Handle):
    """A particle that may break: its solid, and a clump or spheres (n, 4) of it."""

    _noun = "parent"

    def __init__(self, solid, spheres=(), threads=1):
        if isinstance(spheres, Clump):
            self._make("parent_from_clump", None, solid, spheres, threads)
        else:
            spheres = _array(np.reshape(spheres, (-1, 4)), np.float64)
            self._make("parent_from_solid", None, solid, spheres.ctypes, len(spheres), threads)

    def held(self, density, scale=1.0, **motion):
        """The whole in its place in the world: position, quaternion (of the body axes), velocity and
        angular_velocity; without one of them where, as and at rest as the shape has it."""
        return _filled("held", "parent_held", self, density, scale, *_motion(motion))

    def bytes(self):
        """Bytes beside the solid."""
        return self._number("parent_bytes", ctypes.c_uint64)


class Cache(_Handle):
    """Prepared parents that are used again, within a bound of bytes."""

    _noun = "cache"

    def __init__(self, limit):
        self._make("cache_new", None, limit)

    def parent(self, shape, spheres=(), **options):
        """The parent that was made before of the same shape, grid and spheres, else a new one."""
        options = _Options("solid_options", options)
        spheres = _array(np.reshape(spheres, (-1, 4)), np.float64)
        return Parent.__new__(Parent)._make("cache_parent", options, self, shape, options,
                                            spheres.ctypes, len(spheres))

    def counters(self):
        return _filled("cache_counts", "cache_counters", self)

    def clear(self):
        _call("cache_clear", self)


def _motion(values):
    names = ("position", "quaternion", "velocity", "angular_velocity")
    if not set(values) <= set(names):
        raise TypeError(f"a motion has {', '.join(names)}")
    return [_numbers(values.get(name), 4 if name == "quaternion" else 3) for name in names]


def _held(record):
    """A held body (a Record or a dict of its fields) as the library takes it."""
    struct = _structs["held"]()
    _call("held_init", ctypes.byref(struct), ctypes.sizeof(struct))
    for name, value in (record if isinstance(record, dict) else vars(record)).items():
        kind = dict(struct._fields_)[name]
        setattr(struct, name, kind(*np.ravel(value)) if hasattr(kind, "_length_") else value)
    return struct


class Fragments(_Handle):
    """The fragments of one break, and its dust. Keywords are those of morula_break_options.

    `of` is a Parent, or (fragments, index) for a fragment of an earlier break; `held` the body as the
    solver holds it: Parent.held(), Fragments.held(), or a dict of the fields of morula_held.
    """

    _noun = "fragments"

    def __init__(self, of, held, **options):
        options = _Options("break_options", options)
        parent, (before, index) = (of, (None, 0)) if isinstance(of, Parent) else (None, of)
        self._make("parent_break", options, parent, before, index, ctypes.byref(_held(held)),
                   options)

    @classmethod
    def of_parents(cls, parents, held, options=None):
        """All breaks of one time step, which the threads of the first options (dicts) share."""
        count = len(parents)
        if len(held) != count or (options is not None and len(options) != count):
            raise ValueError("a held body and options for each parent")
        handles = (ctypes.c_void_p * count)(*(p._as_parameter_ for p in parents))
        bodies = (_structs["held"] * count)(*(_held(h) for h in held))
        own = [_Options("break_options", o) for o in options or []]
        structs = (_structs["break_options"] * count)(*(o.struct for o in own)) if own else None
        out = (ctypes.c_void_p * count)()
        try:
            _call("parents_break", handles, None, None, bodies, structs, count, out, None)
        except Error:
            if own and own[0].raised is not None:
                raise own[0].raised from None
            raise
        all_of_them = [cls._wrap(pointer) for pointer in out]
        if own and own[0].raised is not None:
            raise own[0].raised
        return all_of_them

    @classmethod
    def from_labels(cls, labels, held, spheres=(), spacing=1.0, origin=0.0, solid=None, **options):
        """The pieces of a label volume (z, y, x), as a fracture model gives them."""
        options = _Options("break_options", options)
        grid = _Options("solid_options", solid or {})
        labels = _array(labels, np.uint32)
        spheres = _array(np.reshape(spheres, (-1, 4)), np.float64)
        return cls.__new__(cls)._make("fragments_from_labels", options, labels.ctypes,
                                      *_grid(labels, spacing, origin), grid, spheres.ctypes,
                                      len(spheres), ctypes.byref(_held(held)), options)

    @classmethod
    def reclump(cls, solid, spheres, held, **options):
        """New spheres for a shape that has changed, from the old ones."""
        options = _Options("break_options", options)
        spheres = _array(np.reshape(spheres, (-1, 4)), np.float64)
        return cls.__new__(cls)._make("reclump_shape", options, solid, spheres.ctypes,
                                      len(spheres), ctypes.byref(_held(held)), options)

    @classmethod
    def deserialize(cls, parent, data, held):
        """What serialize() gave, as fragment 0, beside a parent of the same shape and grid."""
        return cls.__new__(cls)._make("fragments_deserialize", None, parent, bytes(data),
                                      len(data), ctypes.byref(_held(held)))

    def serialize(self, index):
        return self._bytes("fragments_serialize", index)

    def __len__(self):
        return self._number("fragments_count", ctypes.c_size_t)

    def __getitem__(self, index):
        """What a solver takes of a fragment, and its quality."""
        if not 0 <= index < len(self):
            raise IndexError(index)
        return _filled("fragment", "fragments_get", self, index)

    def dust(self):
        count = self._number("fragments_dust_count", ctypes.c_size_t)
        return [_filled("fragment", "fragments_dust", self, i) for i in range(count)]

    def totals(self):
        return _filled("break_totals", "fragments_totals", self)

    def held(self, index, **motion):
        """A fragment as it was handed over, or as it stands and moves now, to break again."""
        return _filled("held", "fragments_held", self, index, *_motion(motion))

    def spheres(self, index, frame="input"):
        return self._copy("fragments_copy_spheres", (self[index].sphere_count, 4),
                          before=(index, constant("FRAME", frame)))

    def grown(self, index, part, others=(), gap=0.0, frame="input"):
        """The spheres grown by a part from 0 to 1 as far as the others leave room."""
        others = _array(np.reshape(others, (-1, 4)), np.float64)
        return self._copy("fragments_grow", (self[index].sphere_count, 4), before=(
            index, part, others.ctypes, len(others), gap, constant("FRAME", frame)))

    def masses(self, index):
        return self._copy("fragments_copy_masses", (self[index].sphere_count,), before=(index,))

    def map(self, index):
        """starts, parents, shares: sphere i comes from those from starts[i] up to starts[i + 1]."""
        fragment = self[index]
        starts = np.empty(fragment.sphere_count + 1, dtype=np.uint32)
        parents, shares = np.empty(fragment.map_count, np.uint32), np.empty(fragment.map_count)
        _call("fragments_copy_map", self, index, starts.ctypes, fragment.map_count,
              parents.ctypes, shares.ctypes)
        return starts, parents, shares

    def half_spaces(self, index):
        return self._copy("fragments_copy_half_spaces", (self[index].half_space_count, 4),
                          before=(index,))

    def shape(self, index):
        """The surface of a fragment."""
        return Shape.__new__(Shape)._make("fragments_shape", None, self, index)

    def notes(self):
        return self._texts("fragments_note")


class Cost(_Handle):
    """A price list: what accuracy costs, line by line. Keywords are those of morula_clump_options;
    `cost` is a dict of morula_cost_options, in which contact is one of morula_contact_options."""

    _noun = "cost"

    def __init__(self, solid, cost=None, **options):
        options = _Options("clump_options", options)
        cost = _Options("cost_options", cost or {})
        self._make("cost_curve", options, solid, options, cost)

    def __len__(self):
        return self._number("cost_count", ctypes.c_size_t)

    def cut(self):
        """Whether cancel or the deadline ended it early."""
        return self._number("cost_cut", ctypes.c_int32) != 0

    def points(self):
        """All lines, by the number of spheres."""
        struct = _structs["cost_point"]
        out = (struct * len(self))()
        out[0].struct_size = ctypes.sizeof(struct)
        _call("cost_copy", self, len(out), out)
        return [Record(point) for point in out]

    def clump(self, index):
        """The clump of a line, which lives on without the list."""
        return Clump.__new__(Clump)._make("cost_clump", None, self, index)

    def choose(self, **bounds):
        """The best line within bounds (of morula_cost_bounds; default: the knee), and why."""
        bounds, index = _Options("cost_bounds", bounds), ctypes.c_size_t()
        why = self._text("cost_choose", bounds, ctypes.byref(index))
        return index.value, why


class Sweep(_Handle):
    """Price lists of one shape: for each of `resolutions` (numbers of cells, as `solid` says, a dict
    of morula_solid_options), in it for each of `methods`, of each for each of `deadlines` in seconds.
    `efforts` are as many as methods; without them all have that of the keywords, which are those of
    morula_clump_options. `cost` as in Cost."""

    _noun = "sweep"

    def __init__(self, shape, resolutions, methods, efforts=None, deadlines=(0.0,), solid=None,
                 cost=None, **options):
        numbers = lambda group, names: [constant(group, name) for name in names]
        over = {"resolutions": resolutions, "methods": numbers("METHOD", methods),
                "deadlines": deadlines}
        if efforts is not None:
            over["efforts"] = numbers("EFFORT", efforts)
        over = _Options("sweep_options", over)
        grid = _Options("solid_options", solid or {})
        cost = _Options("cost_options", cost or {})
        options = _Options("clump_options", options)
        self._make("sweep_from_shape", options, shape, grid, options, cost, over)

    def __len__(self):
        return self._number("sweep_count", ctypes.c_size_t)

    def lists(self):
        """What each list is of, and the status of one that could not be made."""
        struct = _structs["swept"]
        out = (struct * len(self))()
        out[0].struct_size = ctypes.sizeof(struct)
        _call("sweep_copy", self, len(out), out)
        return [Record(one) for one in out]

    def curve(self, index):
        """A list, which lives on without the sweep; raises why it could not be made."""
        return Cost.__new__(Cost)._make("sweep_curve", None, self, index)


def _list_labels(count, copy):
    n = ctypes.c_size_t()
    count(ctypes.byref(n))
    ids, cells = np.empty(n.value, np.uint32), np.empty(n.value, np.uint64)
    boxes, touches = np.empty((n.value, 2, 3), np.uint64), np.empty(n.value, np.int32)
    copy(n.value, ids.ctypes, cells.ctypes, boxes.ctypes, touches.ctypes, ctypes.byref(n))
    return ids, cells, boxes, touches != 0


def labels(volume):
    """The labels of a volume (z, y, x), ascending, without 0: ids, cells, boxes (first and last cell
    along x, y, z of each), whether they touch the border."""
    volume = _array(volume, np.uint32)
    dims, _, _ = _grid(volume, 1.0, 0.0)
    return _list_labels(lambda n: _call("labels_count", volume.ctypes, dims, n),
                        lambda *to: _call("labels_copy", volume.ctypes, dims, *to[:-1]))


def _labels_of(name, options, *of):
    file = _Options("file_options", _split(options, "file_options"))
    checks = _Options("import_options", options)
    return _list_labels(
        lambda n: _call(name, *of, checks, file, 0, None, None, None, None, n),
        lambda *to: _call(name, *of, checks, file, *to))


def labels_from_file(path, **options):
    """The same of a label volume in a file."""
    return _labels_of("labels_from_file", options, _path(path))


def labels_from_bytes(data, name="", **options):
    """The same of the bytes of a file."""
    return _labels_of("labels_from_bytes", options, bytes(data), len(data), name.encode())


def primitives():
    """The built-in analytic particles: a dict of names, each with its parameters and defaults."""
    found, i = {}, 0
    while (name := _functions["primitive_name"](i)) is not None:
        count, value = ctypes.c_size_t(), ctypes.c_double()
        _call("primitive_parameter_count", name, ctypes.byref(count))
        found[name.decode()] = parameters = {}
        for k in range(count.value):
            key = _text(lambda *to: _call("primitive_copy_parameter", name, k, *to,
                                          ctypes.byref(value)))
            parameters[key] = value.value
        i += 1
    return found


def random_orientations(seed, count):
    """Rotations (n, 4) drawn evenly from all: the same for the same seed."""
    out = np.empty((count, 4))
    _call("random_orientations", seed, count, out.ctypes)
    return out


def tensor(inertia):
    """The 3 x 3 matrix of xx, yy, zz, xy, xz, yz."""
    xx, yy, zz, xy, xz, yz = inertia
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


_log = None


def set_log(sink):
    """Sends the library's log lines to sink(level, text), from any thread; None: nowhere."""
    global _log
    entry = None if sink is None else _LogType(
        lambda level, text, _user: sink(level, text.decode("utf-8", "replace")))
    _call("set_log", entry and ctypes.cast(entry, ctypes.c_void_p), None)
    _log = entry
