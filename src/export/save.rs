use super::{File, Place};
use crate::error::{Error, Result};
use std::ffi::OsString;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Writes the files of a format: each under another name beside its own, all flushed, then all renamed, so
/// that no half-written file has the name asked for. What stands there and is no file (a device, a
/// pipe) is written to as it is; a link stays one.
pub fn save(files: &[File], path: &Path) -> Result<()> {
    let below = |file: &File| matches!(file.place, Place::Below(_));
    put(files.iter().map(|f| (f.place.of(path), below(f), &f.bytes[..])))
}

/// Writes files, by their names, into a folder that is made where there is none, in the same way.
pub fn save_in(folder: &Path, files: &[(String, Vec<u8>)]) -> Result<()> {
    put(files.iter().map(|(name, bytes)| (folder.join(name), true, &bytes[..])))
}

/// Each with its path, and whether the path's folder is made.
fn put<'a>(mut files: impl Iterator<Item = (PathBuf, bool, &'a [u8])>) -> Result<()> {
    let mut made: Vec<(PathBuf, PathBuf)> = Vec::new();
    let written = files.try_for_each(|(target, below, bytes)| {
        let target = fs::canonicalize(&target).unwrap_or(target);
        let said = |e: std::io::Error| Error::Io(format!("{}: {e}", target.display()));
        if let (true, Some(folder)) = (below, target.parent()) {
            fs::create_dir_all(folder).map_err(said)?;
        }
        if fs::metadata(&target).is_ok_and(|m| !m.is_file() && !m.is_dir()) {
            let mut out = fs::OpenOptions::new().write(true).open(&target).map_err(said)?;
            return out.write_all(bytes).and_then(|()| out.flush()).map_err(said);
        }
        if target.is_dir() {
            return Err(Error::Io(format!("{}: a folder has that name", target.display())));
        }
        let (part, mut out) = fresh(&target).map_err(said)?;
        made.push((part, target.clone()));
        out.write_all(bytes).and_then(|()| out.sync_all()).map_err(said)
    });
    let renamed = written.and_then(|()| {
        made.iter().try_for_each(|(part, target)| {
            fs::rename(part, target).map_err(|e| Error::Io(format!("{}: {e}", target.display())))
        })
    });
    if renamed.is_err() {
        // What was renamed is whole; the rest goes.
        made.iter().for_each(|(part, _)| {
            let _ = fs::remove_file(part);
        });
    }
    renamed
}

/// A new file beside the path, that no other process has: several may write the same clump.
fn fresh(path: &Path) -> std::io::Result<(PathBuf, fs::File)> {
    let mut last = std::io::ErrorKind::AlreadyExists.into();
    for k in 0..100 {
        let part = beside(path, &format!("{}-{k}.part", std::process::id()));
        match fs::OpenOptions::new().write(true).create_new(true).open(&part) {
            Ok(file) => return Ok((part, file)),
            Err(e) if e.kind() == std::io::ErrorKind::AlreadyExists => last = e,
            Err(e) => return Err(e),
        }
    }
    Err(last)
}

impl Place {
    /// The path of the file, when the format is written to `path`.
    pub fn of(self, path: &Path) -> PathBuf {
        match self {
            Place::At => path.to_path_buf(),
            Place::Beside(ending) => beside(path, ending),
            Place::Below(name) => path.join(name),
        }
    }
}

/// The path with an ending added to its own.
fn beside(path: &Path, ending: &str) -> PathBuf {
    let mut name = OsString::from(path.as_os_str());
    name.push(".");
    name.push(ending);
    name.into()
}
