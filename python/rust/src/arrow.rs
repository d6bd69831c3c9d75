//! Columns for other libraries by the Arrow C data interface, without a copy
//! (<https://arrow.apache.org/docs/format/CDataInterface.html>): an array of doubles, and a stream of
//! one batch of such columns.

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::ptr::{null, null_mut};

use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyList, PyTuple};

#[repr(C)]
struct ArrowSchema {
    format: *const c_char,
    name: *const c_char,
    metadata: *const c_char,
    flags: i64,
    n_children: i64,
    children: *mut *mut ArrowSchema,
    dictionary: *mut ArrowSchema,
    release: Option<unsafe extern "C" fn(*mut ArrowSchema)>,
    private_data: *mut c_void,
}

#[repr(C)]
struct ArrowArray {
    length: i64,
    null_count: i64,
    offset: i64,
    n_buffers: i64,
    n_children: i64,
    buffers: *mut *const c_void,
    children: *mut *mut ArrowArray,
    dictionary: *mut ArrowArray,
    release: Option<unsafe extern "C" fn(*mut ArrowArray)>,
    private_data: *mut c_void,
}

#[repr(C)]
struct ArrowArrayStream {
    get_schema: unsafe extern "C" fn(*mut ArrowArrayStream, *mut ArrowSchema) -> c_int,
    get_next: unsafe extern "C" fn(*mut ArrowArrayStream, *mut ArrowArray) -> c_int,
    get_last_error: unsafe extern "C" fn(*mut ArrowArrayStream) -> *const c_char,
    release: Option<unsafe extern "C" fn(*mut ArrowArrayStream)>,
    private_data: *mut c_void,
}

/// What a schema owns.
struct OwnedSchema {
    _format: CString,
    _name: CString,
    children: Vec<*mut ArrowSchema>,
}

/// What an array owns: the NumPy array that its values lie in, or the arrays of its columns.
struct OwnedArray {
    _values: Option<Py<PyAny>>,
    buffers: Vec<*const c_void>,
    children: Vec<*mut ArrowArray>,
}

impl ArrowSchema {
    fn new(format: &CStr, name: CString, children: Vec<Self>) -> Self {
        let children = children.into_iter().map(|child| Box::into_raw(Box::new(child))).collect();
        let mut owned = Box::new(OwnedSchema { _format: format.to_owned(), _name: name, children });
        Self {
            format: owned._format.as_ptr(),
            name: owned._name.as_ptr(),
            metadata: null(),
            flags: 0,
            n_children: owned.children.len() as i64,
            children: owned.children.as_mut_ptr(),
            dictionary: null_mut(),
            release: Some(release_schema),
            private_data: Box::into_raw(owned).cast(),
        }
    }
}

impl ArrowArray {
    fn new(length: usize, owned: OwnedArray) -> Self {
        let mut owned = Box::new(owned);
        Self {
            length: length as i64,
            null_count: 0,
            offset: 0,
            n_buffers: owned.buffers.len() as i64,
            n_children: owned.children.len() as i64,
            buffers: owned.buffers.as_mut_ptr(),
            children: owned.children.as_mut_ptr(),
            dictionary: null_mut(),
            release: Some(release_array),
            private_data: Box::into_raw(owned).cast(),
        }
    }

    /// The values of a contiguous NumPy array, which lives as long as this.
    fn of(values: &Bound<'_, PyArray1<f64>>) -> PyResult<Self> {
        let read = values.try_readonly()?;
        let slice = read.as_slice()?;
        let buffers = vec![null(), slice.as_ptr().cast()];
        let (length, owner) = (slice.len(), values.clone().into_any().unbind());
        Ok(Self::new(length, OwnedArray { _values: Some(owner), buffers, children: Vec::new() }))
    }

    /// An array that was released: the end of a stream.
    fn released() -> Self {
        Self {
            length: 0,
            null_count: 0,
            offset: 0,
            n_buffers: 0,
            n_children: 0,
            buffers: null_mut(),
            children: null_mut(),
            dictionary: null_mut(),
            release: None,
            private_data: null_mut(),
        }
    }
}

/// # Safety
/// `schema` was made by [`ArrowSchema::new`] and has not been released.
unsafe extern "C" fn release_schema(schema: *mut ArrowSchema) {
    // SAFETY: the pointer is valid by the interface, and `private_data` comes from `Box::into_raw`
    // in `ArrowSchema::new`; children come from there as well, and are released once.
    unsafe {
        let owned = Box::from_raw((*schema).private_data.cast::<OwnedSchema>());
        for &child in &owned.children {
            drop(Box::from_raw(child.cast::<Held<ArrowSchema>>()));
        }
        (*schema).release = None;
    }
}

/// # Safety
/// `array` was made by [`ArrowArray::new`] and has not been released.
unsafe extern "C" fn release_array(array: *mut ArrowArray) {
    // SAFETY: as in `release_schema`. A consumer may take a child for itself, which then has no
    // `release` any more, so that it is not released twice.
    unsafe {
        // the NumPy array goes when somebody has the interpreter next: PyO3 waits with that
        let owned = Box::from_raw((*array).private_data.cast::<OwnedArray>());
        for &child in &owned.children {
            drop(Box::from_raw(child.cast::<Held<ArrowArray>>()));
        }
        (*array).release = None;
        drop(owned);
    }
}

/// A table of one batch, and what of it is not handed over yet.
struct Batch {
    names: Vec<CString>,
    array: Option<Held<ArrowArray>>,
}

/// The schema of columns of doubles.
fn table_schema(names: &[CString]) -> ArrowSchema {
    let column = |name: &CString| ArrowSchema::new(c"g", name.clone(), Vec::new());
    ArrowSchema::new(c"+s", CString::default(), names.iter().map(column).collect())
}

/// # Safety
/// By the interface: the stream is one of [`arrow_stream`], `out` is valid to be written.
unsafe extern "C" fn get_schema(stream: *mut ArrowArrayStream, out: *mut ArrowSchema) -> c_int {
    // SAFETY: `private_data` is a `Batch` as long as the stream is not released
    unsafe {
        let batch = &*(*stream).private_data.cast::<Batch>();
        out.write(table_schema(&batch.names));
    }
    0
}

/// # Safety
/// As [`get_schema`].
unsafe extern "C" fn get_next(stream: *mut ArrowArrayStream, out: *mut ArrowArray) -> c_int {
    // SAFETY: as in `get_schema`
    unsafe {
        let batch = &mut *(*stream).private_data.cast::<Batch>();
        out.write(match batch.array.take() {
            // the consumer releases it
            Some(array) => std::ptr::read(&std::mem::ManuallyDrop::new(array).0),
            None => ArrowArray::released(),
        });
    }
    0
}

/// # Safety
/// None is needed: there are no errors to tell of.
unsafe extern "C" fn get_last_error(_: *mut ArrowArrayStream) -> *const c_char {
    null()
}

/// # Safety
/// The stream has not been released.
unsafe extern "C" fn release_stream(stream: *mut ArrowArrayStream) {
    // SAFETY: `private_data` comes from `Box::into_raw` in `arrow_stream`
    unsafe {
        drop(Box::from_raw((*stream).private_data.cast::<Batch>()));
        (*stream).release = None;
    }
}

/// A structure in a capsule; what nobody took is released with it. Its first byte is that of the
/// structure, which is what a capsule points to.
#[repr(transparent)]
struct Held<T: Released>(T);

// SAFETY: the structures are only read and released, which may happen on any thread
unsafe impl<T: Released> Send for Held<T> {}

impl<T: Released> Drop for Held<T> {
    fn drop(&mut self) {
        self.0.release();
    }
}

/// A structure of the interface.
trait Released {
    /// Releases what nobody has released or taken.
    fn release(&mut self);
}

macro_rules! released {
    ($($kind:ident),*) => {
        $(impl Released for $kind {
            fn release(&mut self) {
                if let Some(release) = self.release {
                    // SAFETY: it was made here, and what is released or taken has no `release`
                    unsafe { release(self) };
                }
            }
        })*
    };
}

released!(ArrowSchema, ArrowArray, ArrowArrayStream);

fn name_of(text: &str) -> PyResult<CString> {
    CString::new(text).map_err(|_| PyValueError::new_err("a name holds the character NUL"))
}

/// The capsules of the schema and of the array of a contiguous NumPy array of doubles.
#[pyfunction]
pub(crate) fn arrow_array<'py>(
    py: Python<'py>,
    values: &Bound<'py, PyArray1<f64>>,
) -> PyResult<Bound<'py, PyTuple>> {
    let array = ArrowArray::of(values)?;
    let schema = ArrowSchema::new(c"g", CString::default(), Vec::new());
    let schema = PyCapsule::new_with_value(py, Held(schema), c"arrow_schema")?;
    let array = PyCapsule::new_with_value(py, Held(array), c"arrow_array")?;
    (schema, array).into_pyobject(py)
}

/// The capsule of a stream of one batch of named columns.
#[pyfunction]
pub(crate) fn arrow_stream<'py>(
    py: Python<'py>,
    names: Vec<String>,
    columns: &Bound<'py, PyList>,
) -> PyResult<Bound<'py, PyCapsule>> {
    let names = names.iter().map(|name| name_of(name)).collect::<PyResult<Vec<_>>>()?;
    let columns: Vec<Bound<'py, PyArray1<f64>>> = columns.extract()?;
    let arrays = columns.iter().map(ArrowArray::of).collect::<PyResult<Vec<_>>>()?;
    let length = arrays.first().map_or(0, |array| array.length);
    let even = arrays.iter().all(|array| array.length == length) && arrays.len() == names.len();
    let children = arrays.into_iter().map(|array| Box::into_raw(Box::new(array))).collect();
    let owned = OwnedArray { _values: None, buffers: vec![null()], children };
    let array = Some(Held(ArrowArray::new(length as usize, owned)));
    let batch = Batch { names, array };
    if !even {
        return Err(PyValueError::new_err("the columns have different lengths"));
    }
    let stream = ArrowArrayStream {
        get_schema,
        get_next,
        get_last_error,
        release: Some(release_stream),
        private_data: Box::into_raw(Box::new(batch)).cast(),
    };
    PyCapsule::new_with_value(py, Held(stream), c"arrow_array_stream")
}
