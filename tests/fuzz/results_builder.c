#include "fuzz/results_builder.h"

#include <math.h>

#include "base/memory.h"
#include "store/h5_data.h"
#include "store/h5_file.h"
#include "store/results_block.h"

/* ---- objects: what a results file is made of ---- */

enum object {
    FILETYPE,
    VERSION,
    SEED,
    CAMPAIGN,
    SETS, /* attributes */
    N_ATTRIBUTES,
    ID = N_ATTRIBUTES,
    STATUS,
    CAUSE,
    PATH,
    LOAD,
    IMPACT,
    HIGH,
    ANGLE,
    COLUMNS
};

enum place { HERE, NOWHERE, GROUP, DATATYPE, SOFT_LINK, HARD_LINK, OUTER_LINK, N_PLACES };
enum layout { PLAIN, COMPACT, CHUNKS, DEFLATED, CHECKED, EARLY, ELSEWHERE, VIRTUAL, N_LAYOUTS };
enum {
    MAX_OBJECTS = 64,
    MAX_VALUES = 1 << 16,
    MAX_ATTRIBUTE = 1 << 18,
    N_TYPES = 18,
    VARIABLE = 0,
    FIXED = 1,
    DOUBLE = 2,
    U64 = 3,
    I32 = 4
};

typedef struct recipe {
    enum place  place;
    size_t      other;   /* object that a link leads to */
    int         type;    /* of type_of */
    size_t      n_bytes; /* of a fixed text */
    int         charset, padding;
    int         rank; /* 0: scalar; -1: no space at all */
    hsize_t     dims[3];
    enum layout layout;
    hsize_t     chunk;
    bool        is_written, has_fill, is_odd;
    double      fill, odd; /* odd: the value at odd_at */
    size_t      odd_at;
    const char *text;
} recipe;

typedef struct plan {
    const char *path;
    size_t      n;
    recipe      objects[MAX_OBJECTS];
    bool        has_group;
} plan;

static char long_text[70000];

static const char *name_of(size_t i)
{
    static const char *const names[] = {
        "filetype", "format_version", "seed",      "campaign",         "sets",           "id",       "status",
        "cause",    "path",           "wear_load", "wear_load_impact", "wear_load_high", "angle_deg"};
    return i < COLUMNS ? names[i] : fw_record_columns[i - COLUMNS].name;
}

static hid_t type_of(const recipe *r)
{
    hid_t type = -1;
    switch (r->type % N_TYPES) {
    case VARIABLE:
    case FIXED:
        type = H5Tcopy(H5T_C_S1);
        H5Tset_size(type, r->type == VARIABLE ? H5T_VARIABLE : r->n_bytes);
        H5Tset_cset(type, (H5T_cset_t)r->charset);
        H5Tset_strpad(type, (H5T_str_t)r->padding);
        return type;
    case DOUBLE: return H5Tcopy(H5T_IEEE_F64LE);
    case U64: return H5Tcopy(H5T_STD_U64LE);
    case I32: return H5Tcopy(H5T_STD_I32LE);
    case 5: return H5Tcopy(H5T_IEEE_F64BE);
    case 6: return H5Tcopy(H5T_IEEE_F32LE);
    case 7: return H5Tcopy(H5T_NATIVE_LDOUBLE);
    case 8: return H5Tcopy(H5T_STD_I64BE);
    case 9: return H5Tcopy(H5T_STD_I8LE);
    case 10: return H5Tcopy(H5T_STD_U16BE);
    case 11: return H5Tcopy(H5T_STD_B64LE);
    case 12: return H5Tcopy(H5T_STD_REF_OBJ);
    case 13: return H5Tcreate(H5T_OPAQUE, 8);
    case 14: return H5Tvlen_create(H5T_NATIVE_DOUBLE);
    case 15: return H5Tenum_create(H5T_NATIVE_INT);
    case 16: return H5Tarray_create2(H5T_NATIVE_DOUBLE, 1, (hsize_t[]){2});
    default:
        type = H5Tcreate(H5T_COMPOUND, 8);
        H5Tinsert(type, "x", 0, H5T_NATIVE_DOUBLE);
        return type;
    }
}

/* ---- orders ---- */

static double odd_number(uint8_t i)
{
    static const double numbers[] = {0,
                                     -1,
                                     1,
                                     2,
                                     3,
                                     100,
                                     -0.5,
                                     1e300,
                                     NAN,
                                     255,
                                     INFINITY,
                                     2147483648.,
                                     4294967296.,
                                     9223372036854775808.,
                                     1.8446744073709552e19,
                                     -INFINITY};
    return numbers[i % 16];
}

static const char *odd_text(uint8_t i)
{
    static const char *const texts[] = {"", "floewear trajectory", "\xff\xfe", "floewear results ", "1", long_text};
    return texts[i % 6];
}

static void spoil(plan *p, const uint8_t order[4])
{
    size_t  which = order[0] % p->n;
    recipe *r = &p->objects[which];
    uint8_t a = order[2], b = order[3];
    switch (order[1] % 14) {
    case 0: r->place = (enum place)(a % N_PLACES), r->other = b % p->n; break;
    case 1: r->type = a % N_TYPES, r->n_bytes = 1u + b; break;
    case 2: r->rank = a % 5 - 1; break;
    case 3: r->dims[a % 3] = b; break;
    case 4: r->dims[a % 3] = (hsize_t)1 << b % 63, r->layout = CHUNKS, r->is_written = false; break;
    case 5: r->layout = (enum layout)(a % N_LAYOUTS), r->chunk = 1u + b; break;
    case 6: r->has_fill = true, r->fill = odd_number(a); break;
    case 7: r->is_odd = true, r->odd_at = a, r->odd = odd_number(b); break;
    case 8: r->text = odd_text(a); break;
    case 9: r->charset = a % 2, r->padding = b % 3; break;
    case 10: r->is_written = false; break;
    case 11: p->has_group = false; break;
    case 12: r->is_odd = true, r->odd_at = a, r->odd = b; break;
    default: /* all datasets alike: more rows than there are values */
        for (size_t i = ID; i < p->n; i++) {
            if (i != ANGLE) p->objects[i].dims[0] = a % 2 ? b : (hsize_t)1 << b % 63;
            if (a % 4 < 2) p->objects[i].layout = CHUNKS, p->objects[i].is_written = false;
        }
    }
}

static void make_plan(plan *p, const char *path, const uint8_t *orders, size_t n_orders, fuzz_built *sizes)
{
    memset(long_text, 'x', sizeof long_text - 1);
    *sizes = (fuzz_built){.n = orders[0] % 17, .n_laws = orders[1] % (FW_MAX_LAWS + 2), .n_arcs = orders[2] % 80};
    *p = (plan){.path = path, .n = COLUMNS + fw_n_record_columns, .has_group = true};
    FUZZ_LAW(p->n <= MAX_OBJECTS, "%zu objects", p->n);
    for (size_t i = 0; i < p->n; i++) {
        recipe *r = &p->objects[i];
        bool    is_ring = i >= LOAD && i <= HIGH;
        *r = (recipe){.type = DOUBLE, .rank = is_ring ? 3 : i == PATH ? 2 : i < SETS ? 0 : 1, .is_written = true};
        r->charset = H5T_CSET_UTF8;
        r->padding = H5T_STR_NULLPAD;
        r->n_bytes = FW_RESULTS_CAUSE;
        r->dims[0] = i == SETS ? FUZZ_N_SETS : i == ANGLE ? sizes->n_arcs : sizes->n;
        r->dims[1] = is_ring ? sizes->n_laws : sizes->n_arcs;
        r->dims[2] = sizes->n_arcs;
        r->chunk = 4;
    }
    p->objects[FILETYPE].type = p->objects[CAMPAIGN].type = p->objects[SETS].type = VARIABLE;
    p->objects[FILETYPE].text = FW_RESULTS_FILETYPE;
    p->objects[CAMPAIGN].text = FUZZ_CAMPAIGN;
    p->objects[VERSION].type = p->objects[SEED].type = p->objects[ID].type = U64;
    p->objects[STATUS].type = I32;
    p->objects[CAUSE].type = FIXED;
    sizes->is_good = n_orders < 7 && sizes->n_laws >= 1 && sizes->n_laws <= FW_MAX_LAWS && sizes->n_arcs >= 1;
    for (size_t at = 3; at + 4 <= n_orders; at += 4) spoil(p, orders + at);
}

/* ---- values ---- */

static bool is_failed(uint64_t row) { return row % 3 == 2; }

static double value_of(size_t object, size_t i)
{
    if (object == VERSION) return FW_RESULTS_VERSION;
    if (object == SEED) return FUZZ_SEED;
    if (object == STATUS) return is_failed(i) ? FW_E_LIMIT : FW_OK;
    return object == ID ? (double)i : 0.25 * (double)i + (double)object;
}

static const char *text_of(const recipe *r, size_t object, size_t i)
{
    if (r->text != NULL) return r->text;
    if (object == SETS) return i == 0 ? "seed=7" : "";
    return object == CAUSE && is_failed(i) ? "limit" : "";
}

void fuzz_expected_record(const fuzz_built *b, uint64_t id, fw_record *r)
{
    r->id = id;
    r->status = is_failed(id) ? FW_E_LIMIT : FW_OK;
    snprintf(r->cause, sizeof r->cause, "%s", is_failed(id) ? "limit" : "");
    for (size_t i = 0; i < fw_n_record_columns; i++) {
        double v = value_of(COLUMNS + i, (size_t)id);
        memcpy((char *)r + fw_record_columns[i].offset, &v, sizeof v);
    }
    for (size_t k = 0; k < b->n_arcs; k++) r->rings[k] = value_of(PATH, (size_t)id * b->n_arcs + k);
    for (size_t law = 0; law < b->n_laws; law++) {
        for (size_t k = 0; k < b->n_arcs; k++) {
            size_t at = ((size_t)id * b->n_laws + law) * b->n_arcs + k;
            for (size_t w = 0; w < FW_RINGS_PER_LAW; w++)
                r->rings[b->n_arcs * (1 + FW_RINGS_PER_LAW * law + w) + k] = value_of(LOAD + w, at);
        }
    }
}

/* Its values in memory: doubles that HDF5 converts, or texts. NULL: none that this type can be given. */
static void *make_values(const recipe *r, size_t object, size_t n, hid_t *memory_type)
{
    void *values = NULL;
    if (r->type == VARIABLE || r->type == FIXED) {
        *memory_type = type_of(r);
        FUZZ_LAW(fw_alloc(&values, n, r->type == VARIABLE ? sizeof(char *) : r->n_bytes, "values", NULL) == FW_OK, "-");
        for (size_t i = 0; i < n; i++) {
            const char *text = text_of(r, object, i);
            if (r->type == VARIABLE)
                memcpy((char *)values + i * sizeof(char *), &text, sizeof text);
            else
                memcpy((char *)values + i * r->n_bytes, text, strnlen(text, r->n_bytes));
        }
    } else if (r->type <= 10) {
        *memory_type = H5Tcopy(H5T_NATIVE_DOUBLE);
        FUZZ_LAW(fw_alloc(&values, n, sizeof(double), "values", NULL) == FW_OK, "-");
        for (size_t i = 0; i < n; i++)
            ((double *)values)[i] = r->is_odd && i == r->odd_at ? r->odd : value_of(object, i);
    }
    return values;
}

/* ---- into the file ---- */

static hid_t creation_list(const recipe *r, const char *path, bool *is_late)
{
    hid_t   list = H5Pcreate(H5P_DATASET_CREATE), space;
    hsize_t chunk[3], all = 8;
    for (int i = 0; i < 3; i++)
        chunk[i] = i > 0 || r->dims[i] < r->chunk ? (r->dims[i] < 256 ? r->dims[i] : 256) : r->chunk;
    for (int i = 0; i < 3; i++) chunk[i] += chunk[i] == 0;
    for (int i = 0; i < r->rank; i++) all *= r->dims[i];
    if (r->layout == COMPACT) H5Pset_layout(list, H5D_COMPACT);
    if (r->layout >= CHUNKS && r->layout <= CHECKED && r->rank > 0) H5Pset_chunk(list, r->rank, chunk);
    if (r->layout == DEFLATED) H5Pset_shuffle(list), H5Pset_deflate(list, 1);
    if (r->layout == CHECKED) H5Pset_fletcher32(list);
    *is_late = r->layout == ELSEWHERE || r->layout == VIRTUAL;
    if (r->layout == EARLY && all < MAX_VALUES) H5Pset_alloc_time(list, H5D_ALLOC_TIME_EARLY);
    if (r->layout == ELSEWHERE) {
        char pipe[FUZZ_PATH + 8]; /* whoever opens it waits */
        snprintf(pipe, sizeof pipe, "%s.pipe", path);
        H5Pset_external(list, r->chunk % 2 ? pipe : "/dev/zero", 0, all);
    }
    if (r->layout == VIRTUAL && r->rank > 0 && (space = H5Screate_simple(r->rank, r->dims, NULL)) >= 0) {
        H5Pset_virtual(list, space, r->chunk % 2 ? "." : "/dev/zero", "/realisations/id", space);
        H5Sclose(space);
    }
    if (r->has_fill && r->type >= DOUBLE && r->type <= 10) H5Pset_fill_value(list, H5T_NATIVE_DOUBLE, &r->fill);
    return list;
}

static void put_data(hid_t at, const char *path, const recipe *r, size_t object)
{
    bool   is_late, is_attribute = object < N_ATTRIBUTES;
    double n = 1; /* HDF5 takes any number for a dataset without values; an attribute it keeps in memory */
    hid_t  type = type_of(r), list = creation_list(r, path, &is_late), id = -1, memory_type = -1;
    hid_t  space = r->rank < 1 ? H5Screate(r->rank < 0 ? H5S_NULL : H5S_SCALAR)
                               : H5Screate_simple(r->rank, r->dims, NULL);
    for (int i = 0; i < r->rank; i++) n *= (double)r->dims[i];
    if (type >= 0 && space >= 0 && (!is_attribute || n < MAX_ATTRIBUTE)) {
        id = is_attribute ? H5Acreate2(at, name_of(object), type, space, H5P_DEFAULT, H5P_DEFAULT)
                          : H5Dcreate2(at, name_of(object), type, space, H5P_DEFAULT, list, H5P_DEFAULT);
    }
    if (id >= 0 && r->is_written && r->rank >= 0 && n > 0 && n < MAX_VALUES && !is_late) {
        void *values = make_values(r, object, (size_t)n, &memory_type);
        if (values != NULL && is_attribute) H5Awrite(id, memory_type, values);
        if (values != NULL && !is_attribute) H5Dwrite(id, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
        free(values);
    }
    if (memory_type >= 0) H5Tclose(memory_type);
    if (id >= 0 && is_attribute) H5Aclose(id);
    if (id >= 0 && !is_attribute) H5Dclose(id);
    if (space >= 0) H5Sclose(space);
    if (type >= 0) H5Tclose(type);
    H5Pclose(list);
}

static void put_object(const plan *p, hid_t file, hid_t group, size_t i)
{
    const recipe *r = &p->objects[i];
    hid_t         id = -1;
    char          other[96];
    snprintf(other, sizeof other, "/realisations/%s", name_of(r->other));
    if (i < N_ATTRIBUTES) {
        if (r->place == HERE) put_data(file, p->path, r, i);
        return;
    }
    switch (r->place) {
    case HERE: put_data(group, p->path, r, i); break;
    case GROUP:
        if ((id = H5Gcreate2(group, name_of(i), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)) >= 0) H5Gclose(id);
        break;
    case DATATYPE:
        if ((id = type_of(r)) >= 0)
            H5Tcommit2(group, name_of(i), id, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Tclose(id);
        break;
    case SOFT_LINK: H5Lcreate_soft(other, group, name_of(i), H5P_DEFAULT, H5P_DEFAULT); break;
    case HARD_LINK: H5Lcreate_hard(file, other, group, name_of(i), H5P_DEFAULT, H5P_DEFAULT); break;
    case OUTER_LINK: H5Lcreate_external("other.h5", other, group, name_of(i), H5P_DEFAULT, H5P_DEFAULT); break;
    default: break;
    }
}

bool fuzz_build_results(const char *path, const uint8_t *orders, size_t n_orders, fuzz_built *out)
{
    plan       p;
    fw_h5_file f;
    hid_t      group = -1;
    if (n_orders < 3) return false;
    make_plan(&p, path, orders, n_orders, out);
    FUZZ_LAW(fw_h5_file_create(&f, path, NULL) == FW_OK, "%s cannot be made", path);
    FUZZ_LAW(fw_h5_put_text(&f, f.id, "settings", "seed = 7\n", NULL) == FW_OK, "%s", path); /* in every file of ours; tests/store spoils it */
    if (p.has_group) group = H5Gcreate2(f.id, "realisations", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    for (size_t i = 0; i < p.n; i++) put_object(&p, f.id, group, i);
    if (group >= 0) H5Gclose(group);
    return fw_h5_file_finish(&f, NULL) == FW_OK;
}
